// For each stretch, after it was drawn: which share of its first points holds a pixel now. Points are shuffled, so the first
// tell of all.
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
  const uint kLooked = 4u;
  // What was known before counts as much as this many points: a short stretch says little
  const float kMemory = 2.0;
  uint s = first_stretch + invocation_index();
  if (s >= end_stretch) return;
  Stretch stretch = stretches[s];
  ClusterState state = states[stretch.cluster];
  if (state.drawn == boxes[stretch.cluster].count) return;  // it has nothing left
  uint looked = min(stretch.count, kLooked);
  uint won = 0u;
  for (uint k = 0u; k < looked; ++k) {
    uint at = places[stretch.begin + k];
    vec3 place;
    if (project(points[at].xyz, place) && texelFetch(target_ids, ivec2(place.xy), 0).x == ids[at]) ++won;
  }
  if (looked > 0u) states[stretch.cluster].seen = (float(won) + kMemory * state.seen) / (float(looked) + kMemory);
}
