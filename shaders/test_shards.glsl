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
layout(std430, binding = 2) readonly buffer FirstCells { uint first_cells[]; };  // SHARDS a cluster
layout(std430, binding = 4) readonly buffer LastCells { uint last_cells[]; };
layout(std430, binding = 5) buffer InSight { Sight sight; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
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
  uint hidden = 0u;
  for (uint left = ~hidden_shards(state); left != 0u; left &= left - 1u) {
    uint shard = uint(findLSB(left));
    if (shard >= box.count) break;
    vec3 from;
    vec3 to;
    shard_box(first_cells[i * SHARDS + shard], last_cells[i * SHARDS + shard], low, high, from, to);
    Outline outline = outline_of_small(from, to, reach);
    if (outline.outside ? culls : open_share(silhouette_of(outline), 1u) == 0.0) hidden |= 1u << shard;
  }
  if ((eyes & 1u) != 0u) state.hidden.x |= hidden;
  if ((eyes & 2u) != 0u) state.hidden.y |= hidden;
  states[i].hidden = state.hidden;
  if (points_left(state, box.count) == 0u) {
    states[i].status = kOccluded;
    atomicAdd(sight.occluded, 1u);
  }
}
