// A work group a stretch, after it was drawn: which share of its first points holds a pixel now. Points are shuffled, so the
// first tell of all.
#include "projection.glsl"
#include "clusters.glsl"
layout(local_size_x = 16) in;

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) readonly buffer Points { ivec4 points[]; };
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 2) buffer States { ClusterState states[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(std430, binding = 3) readonly buffer Places { uint places[]; };
layout(location = 0) uniform uint first_stretch;
layout(location = 1) uniform uint end_stretch;

// What was known before counts as much as this many points: a short stretch says little.
const float kMemory = 2.0;

shared uint won;

void main() {
  uint group = first_stretch + gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (group >= end_stretch) return;
  Stretch stretch = stretches[group];
  uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) won = 0u;
  barrier();
  vec3 place;
  if (lane < stretch.count) {
    uint at = places[stretch.begin + lane];
    if (project(points[at].xyz, place) && texelFetch(target_ids, ivec2(place.xy), 0).x == ids[at]) atomicAdd(won, 1u);
  }
  barrier();
  if (lane > 0u || stretch.count == 0u) return;
  float seen = (float(won) + kMemory * states[stretch.cluster].seen);
  states[stretch.cluster].seen = seen / (float(min(stretch.count, gl_WorkGroupSize.x)) + kMemory);
}
