// For each open cluster: is it wholly behind the depth already drawn. Only certainty rules it out. With TWO_EYES once for each
// eye; the second decides for both.
#include "clusters.glsl"
#include "open_share.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 4) readonly buffer OpenClusters { uint open_clusters[]; };
layout(std430, binding = 5) buffer InSight { Sight sight; };
layout(std430, binding = 6) readonly buffer Silhouettes { Silhouette silhouettes[]; };
layout(std430, binding = 7) buffer Prospects { Prospect prospects[]; };
layout(location = 0) uniform uint count;       // clusters to test
layout(location = 2) uniform bool all;         // not of the open clusters, but of all
#ifdef TWO_EYES
layout(location = 1) uniform uint first_silhouette;  // place of the first of this eye's
layout(location = 4) uniform bool decides;
#endif
// Looking at all of them takes half as long again and saves 1 % of the points.
const uint kEnough = 4u;

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  if (!all) i = open_clusters[i];
#ifdef TWO_EYES
  float open = open_share(silhouettes[first_silhouette + i], kEnough);
  if (decides) open = max(open, prospects[i].open);
  bool hidden = decides && open == 0.0;
#else
  float open = open_share(silhouettes[i], kEnough);
  bool hidden = open == 0.0;
#endif
  if (hidden && states[i].status == kOpen) {
    states[i].status = kOccluded;
    atomicAdd(sight.occluded, 1u);
  }
  prospects[i].open = open;
}
