// Prefix sums over all clusters of what is taken, in two steps: sums of blocks of clusters, an invocation each (SCAN_SUMS),
// then, in one invocation, the sums before each block.
#include "clusters.glsl"
#ifdef SCAN_SUMS
layout(local_size_x = 64) in;
#include "invocation.glsl"
#include "wishes.glsl"

void main() {
  uint block = invocation_index();
  if (block >= blocks) return;
  uvec4 sum = uvec4(0u);
  for (uint left = wishing[block]; left != 0u; left &= left - 1u) sum += wish_of(block * BLOCK + uint(findLSB(left)));
  block_sums[block] = sum;
}

#else
layout(local_size_x = 1) in;

layout(std430, binding = 6) buffer BlockSums { uvec4 block_sums[]; };
layout(location = 0) uniform uint blocks;

void main() {
  uvec4 before = uvec4(0u);
  for (uint b = 0u; b < blocks; ++b) {
    uvec4 here = block_sums[b];
    block_sums[b] = before;
    before += here;
  }
}
#endif
