// S19, section 4.2: arriving points go to shuffled places of the vertex buffer, which is spread over several buffers.
// x -> x^2 mod P visits the quadratic residues once for x <= P/2 and, negated, the others for x > P/2, because
// P = 3 mod 4. Applied twice; between the two a shift by the seed.
layout(local_size_x = 128) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer StagedPoints { ivec4 staged_points[]; };
layout(std430, binding = 1) readonly buffer StagedIds { uint staged_ids[]; };
layout(std430, binding = 2) writeonly buffer ChunkPoints { ivec4 at[]; } chunk_points[CHUNKS];
layout(std430, binding = 2 + CHUNKS) writeonly buffer ChunkIds { uint at[]; } chunk_ids[CHUNKS];

layout(location = 0) uniform uint first;        // index in the source of the first staged point
layout(location = 1) uniform uint count;        // staged points
layout(location = 2) uniform uint prime;        // P <= total, P = 3 mod 4; 0: no shuffle
layout(location = 3) uniform uint seed;         // 0 <= seed < P
layout(location = 4) uniform uint first_chunk;  // of those bound
layout(location = 5) uniform bool has_ids;      // else the id is the index

// x * x mod m, by long division of the 64-bit square
uint square_mod(uint x, uint m) {
  uint high;
  uint low;
  umulExtended(x, x, high, low);
  uint rest = high % m;
  for (int bit = 31; bit >= 0; --bit) {
    // The rest is below m < 2^32: shifting may carry out, then it is certainly above m
    bool carry = (rest & 0x80000000u) != 0u;
    rest = rest << 1 | ((low >> bit) & 1u);
    if (carry || rest >= m) rest -= m;
  }
  return rest;
}

uint permute(uint x, uint p) {
  uint residue = square_mod(x, p);
  return x <= p / 2u ? residue : p - residue;
}

uint shuffled_slot(uint x) {
  if (x >= prime) return x;
  uint once = permute(x, prime);
  uint shifted = once >= prime - seed ? once - (prime - seed) : once + seed;
  return permute(shifted, prime);
}

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  uint slot = shuffled_slot(first + i);
  uint chunk = slot / CHUNK_POINTS - first_chunk;
  uint place = slot % CHUNK_POINTS;
  ivec4 point = staged_points[i];
  uint id = has_ids ? staged_ids[i] : first + i;
  // Buffers may only be chosen by a constant
  switch (chunk) {
    case 0u: chunk_points[0].at[place] = point; chunk_ids[0].at[place] = id; break;
    case 1u: chunk_points[1].at[place] = point; chunk_ids[1].at[place] = id; break;
    case 2u: chunk_points[2].at[place] = point; chunk_ids[2].at[place] = id; break;
#if CHUNKS == 7
    case 3u: chunk_points[3].at[place] = point; chunk_ids[3].at[place] = id; break;
    case 4u: chunk_points[4].at[place] = point; chunk_ids[4].at[place] = id; break;
    case 5u: chunk_points[5].at[place] = point; chunk_ids[5].at[place] = id; break;
    case 6u: chunk_points[6].at[place] = point; chunk_ids[6].at[place] = id; break;
#endif
  }
}
