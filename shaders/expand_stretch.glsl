// An invocation a stretch: where its points are in their chunk's buffer.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) readonly buffer States { ClusterState states[]; };
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
  for (uint k = 0u; k < stretch.count; ++k) {
    uint place = from + k;
    places[stretch.begin + k] = first + (place >= size ? place - size : place);
  }
}
