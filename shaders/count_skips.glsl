// For those who want to know: what of each cluster the view has left out so far.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) readonly buffer States { ClusterState states[]; };
layout(std430, binding = 2) buffer Counts {
  uint clusters_outside;
  uint points_outside;
  uint clusters_hidden;
  uint clusters_done;
  uint points_in_sight;  // in clusters that are
  uint points_open;      // of them, to be drawn yet
  uint points_put_off;
} counts;
layout(std430, binding = 7) readonly buffer Prospects { Prospect prospects[]; };
layout(location = 0) uniform uint count;  // clusters

void main() {
  uint i = invocation_index();
  if (i >= count || boxes[i].count == 0u) return;
  uint points = boxes[i].count;
  uint status = states[i].status;
  if (status == kOutside) {
    atomicAdd(counts.clusters_outside, 1u);
    atomicAdd(counts.points_outside, points);
    return;
  }
  atomicAdd(counts.points_in_sight, points);
  atomicAdd(counts.points_put_off, points - uint(min(ceil(prospects[i].pixels), float(points))));
  uint left = status == kOpen ? points_left(states[i], points) : 0u;
  atomicAdd(counts.points_open, left);
  if (status == kOccluded)
    atomicAdd(counts.clusters_hidden, 1u);
  else if (left == 0u)
    atomicAdd(counts.clusters_done, 1u);
}
