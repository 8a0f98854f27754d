// A work group a stretch: where its points are in their chunk's buffer.
#include "clusters.glsl"
layout(local_size_x = 16) in;

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) readonly buffer States { ClusterState states[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(std430, binding = 2) writeonly buffer Places { uint places[]; };
layout(location = 0) uniform uint stretch_count;

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (group >= stretch_count) return;
  Stretch stretch = stretches[group];
  uint first = boxes[stretch.cluster].place & kPlaceMask;
  uint size = boxes[stretch.cluster].count;
  uint from = states[stretch.cluster].start + stretch.first;
  for (uint k = gl_LocalInvocationID.x; k < stretch.count; k += gl_WorkGroupSize.x) {
    uint place = from + k;
    places[stretch.begin + k] = first + (place >= size ? place - size : place);
  }
}
