// For every other stretch, after it was drawn: does its first point hold a pixel now. Points are shuffled, so it stands for all;
// asking four of each took several times as long and drew no fewer points until 40 dB or equality.
#include "projection.glsl"
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) readonly buffer Points { ivec4 points[]; };
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 2) buffer States { ClusterState states[]; };
layout(std430, binding = 3) readonly buffer Places { uint places[]; };
layout(std430, binding = 4) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(location = 0) uniform uint first_stretch;
layout(location = 1) uniform uint end_stretch;

void main() {
  // What was known before counts as much as this many points
  const float kMemory = 2.0;
  uint s = first_stretch + 2u * invocation_index();
  if (s >= end_stretch) return;
  Stretch stretch = stretches[s];
  if (stretch.count == 0u) return;
  ClusterState state = states[stretch.cluster];
  if (state.drawn == boxes[stretch.cluster].count) return;  // it has nothing left
  uint at = places[stretch.begin];
  vec3 place;
  bool won = project(points[at].xyz, place) && texelFetch(target_ids, ivec2(place.xy), 0).x == ids[at];
  states[stretch.cluster].seen = (float(won) + kMemory * state.seen) / (1.0 + kMemory);
}
