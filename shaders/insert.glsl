// S18's incremental shuffle (docs/decisions/0014-while-loading.md): new points go to random slots among those that are
// taken, what stood there to the end. GATHER collects what stands where new points come; then all are put down.
layout(local_size_x = 128) in;
#include "invocation.glsl"

layout(std430, binding = 0) buffer StagedPoints { ivec4 staged_points[]; };
layout(std430, binding = 1) buffer StagedIds { uint staged_ids[]; };
layout(std430, binding = 2) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 3) writeonly buffer SlotOf { uint slot_of[]; };  // of the point with this id
layout(std430, binding = 4) buffer ChunkPoints { ivec4 at[]; } chunk_points[CHUNKS];
layout(std430, binding = 4 + CHUNKS) buffer ChunkIds { uint at[]; } chunk_ids[CHUNKS];

layout(location = 0) uniform uint first_slot;   // of the list: the slot of the first staged point
layout(location = 1) uniform uint first;        // staged point
layout(location = 2) uniform uint count;
layout(location = 3) uniform uint first_chunk;  // of those bound
layout(location = 4) uniform bool keeps_slots;  // slot_of is there

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  uint slot = slots[first_slot + i];
  uint chunk = slot / CHUNK_POINTS - first_chunk;
  uint place = slot % CHUNK_POINTS;
  uint staged = first + i;
#ifdef GATHER
#define MOVE(C) staged_points[staged] = chunk_points[C].at[place]; staged_ids[staged] = chunk_ids[C].at[place]
#else
  ivec4 point = staged_points[staged];
  uint id = staged_ids[staged];
  if (keeps_slots && first_chunk == 0u) slot_of[id] = slot;
#define MOVE(C) chunk_points[C].at[place] = point; chunk_ids[C].at[place] = id
#endif
  // Buffers may only be chosen by a constant
  switch (chunk) {
    case 0u: MOVE(0); break;
#if CHUNKS > 1
    case 1u: MOVE(1); break;
#endif
#if CHUNKS > 2
    case 2u: MOVE(2); break;
#endif
#if CHUNKS > 3
    case 3u: MOVE(3); break;
#endif
#if CHUNKS > 4
    case 4u: MOVE(4); break;
#endif
#if CHUNKS > 5
    case 5u: MOVE(5); break;
#endif
  }
}
