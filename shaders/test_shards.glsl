// Before the next selection of the same view, for each stretch that was drawn: which of its cluster's shards are out of sight,
// because they lie outside of the frustum or wholly behind what is drawn. Only certainty rules them out. Once for each eye.
#include "projection.glsl"
#include "clusters.glsl"
#include "outline.glsl"
#include "open_share.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 5) buffer InSight { Sight sight; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
// ShardBoxes of each cluster. Texels, because shaders reach more of these than of a storage buffer.
layout(binding = 1) uniform usamplerBuffer shards;
layout(location = 0) uniform uint stretch_count;
layout(location = 1) uniform uint eyes;  // those that this view stands for, a bit each
layout(location = 2) uniform bool culls;  // what is outside of the frustum

void main() {
  uint s = invocation_index();
  if (s >= stretch_count) return;
  uint i = stretches[s].cluster;
  ClusterState state = states[i];
  ClusterBox box = boxes[i];
  if (points_left(state, box.count) == 0u) return;
  vec3 low = world_from_eye(box.low);
  vec3 high = world_from_eye(box.high);
  vec3 reach = max(abs(low), abs(high));
  uvec2 hidden = uvec2(0u);
  uvec2 open = ~hidden_shards(state);
  while (open != uvec2(0u)) {
    uint word = open.x != 0u ? 0u : 1u;
    uint bit = uint(findLSB(open[word]));
    open[word] &= open[word] - 1u;
    uint shard = 32u * word + bit;
    if (shard >= box.count) break;
    vec3 from;
    vec3 to;
    shard_box(texelFetch(shards, int(i * SHARDS + shard)).xy, low, high, from, to);
    Outline outline = outline_of_small(from, to, reach);
    if (outline.outside ? culls : open_share(silhouette_of(outline), 1u) == 0.0) hidden[word] |= 1u << bit;
  }
  if ((eyes & 1u) != 0u) state.hidden.xy |= hidden;
  if ((eyes & 2u) != 0u) state.hidden.zw |= hidden;
  states[i].hidden = state.hidden;
  if (points_left(state, box.count) == 0u) {
    states[i].status = kOccluded;
    atomicAdd(sight.occluded, 1u);
  }
}
