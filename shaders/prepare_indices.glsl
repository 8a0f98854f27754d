// S18's prepare pass: the visible points of a finished frame become places in the cloud's buffers, drawn first in the
// next frame. The places of each chunk stand together, so they are counted (COUNT), given room (BEGIN), and written.
#include "packing.glsl"

layout(std430, binding = 0) readonly buffer SlotOf { uint slot_of[]; };  // of the point with this id
layout(std430, binding = 1) writeonly buffer Places { uint places[]; };
layout(std430, binding = 2) buffer Commands { IndirectCommand commands[]; };  // one a chunk

#ifdef BEGIN

layout(local_size_x = 1) in;
layout(location = 0) uniform uint chunks;
layout(location = 1) uniform uint group_size;

void main() {
  uint begin = 0u;
  for (uint c = 0u; c < chunks; ++c) {
    IndirectCommand command = commands[c];
    command.begin = begin;
    command.instance_count = 1u;
    set_groups(command, group_size);
    begin += command.count;
    command.count = 0u;  // counted again while they are written
    commands[c] = command;
  }
}

#else

layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 1) uniform usampler2D previous_ids;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(previous_ids, 0)))) return;
  uint id = texelFetch(previous_ids, pixel, 0).x;
  if (id == kNoPoint) return;
  uint slot = slot_of[id];
  uint chunk = slot / CHUNK_POINTS;
  uint at = atomicAdd(commands[chunk].count, 1u);
#ifndef COUNT
  places[commands[chunk].begin + at] = slot - chunk * CHUNK_POINTS;
#endif
}

#endif
