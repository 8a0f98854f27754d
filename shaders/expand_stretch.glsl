// An invocation a stretch: where its points are in their chunk's buffer. Shards that cannot be seen are left out.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(std430, binding = 2) writeonly buffer Places { uint places[]; };
layout(location = 0) uniform uint stretch_count;

uint rotated(uint bits, uint right) { return right == 0u ? bits : bits >> right | bits << (SHARDS - right); }

void main() {
  uint s = invocation_index();
  if (s >= stretch_count) return;
  Stretch stretch = stretches[s];
  uint first = boxes[stretch.cluster].place & kPlaceMask;
  uint size = boxes[stretch.cluster].count;
  uint open = ~hidden_shards(states[stretch.cluster]);
  uint first_open = uint(findLSB(open));
  uint place = states[stretch.cluster].start + stretch.first;
  if (place >= size) place -= size;
  uint passed = 0u;
  for (uint k = 0u; k < stretch.count; ++k) {
    // On to the next place of an open shard, around the end of the circle
    uint step = uint(findLSB(rotated(open, place % SHARDS)));
    if (place + step >= size) step = size - place + first_open;
    passed += step + 1u;
    place += step;
    if (place >= size) place -= size;
    places[stretch.begin + k] = first + place;
    if (++place == size) place = 0u;
  }
  states[stretch.cluster].drawn = stretch.first + passed;
}
