// An invocation a stretch: where its points are in their chunk's buffer. Shards that cannot be seen are left out.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(std430, binding = 2) writeonly buffer Places { uint places[]; };
layout(location = 0) uniform uint stretch_count;

void main() {
  uint s = invocation_index();
  if (s >= stretch_count) return;
  Stretch stretch = stretches[s];
  uint first = boxes[stretch.cluster].place & kPlaceMask;
  uint size = boxes[stretch.cluster].count;
  uint from = states[stretch.cluster].start + stretch.first;
  uint hidden = hidden_shards(states[stretch.cluster]);
  uint k = 0u;
  for (uint points = 0u; points < stretch.count; ++k) {
    uint place = from + k;
    if (place >= size) place -= size;
    if ((hidden >> place % SHARDS & 1u) == 0u) places[stretch.begin + points++] = first + place;
  }
  states[stretch.cluster].drawn = stretch.first + k;
}
