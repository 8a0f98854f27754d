// For each open cluster: is it wholly behind the depth already drawn. Only certainty rules it out. With TWO_EYES once for each
// eye; the second decides for both.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 3) readonly buffer Pyramid { float farthest[]; };
layout(std430, binding = 4) readonly buffer OpenClusters { uint open_clusters[]; };
layout(std430, binding = 5) buffer InSight { Sight sight; };
layout(std430, binding = 6) readonly buffer Silhouettes { Silhouette silhouettes[]; };
layout(std430, binding = 7) buffer Prospects { Prospect prospects[]; };
#ifdef FROM_ATTACHMENT
layout(binding = 0) uniform sampler2D depth_drawn;
float drawn_at(ivec2 pixel) { return texelFetch(depth_drawn, pixel, 0).x; }
#else
layout(binding = 0) uniform usampler2D depth_drawn;
float drawn_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth_drawn, pixel, 0).x); }
#endif

layout(location = 0) uniform uint count;       // clusters to test
layout(location = 2) uniform bool all;         // not of the open clusters, but of all
#ifdef TWO_EYES
layout(location = 1) uniform uint first_silhouette;  // place of the first of this eye's
layout(location = 3) uniform bool decides;
#endif
layout(location = 5) uniform uvec4 levels[16];  // of the pyramid: first value, width, height

ivec2 unpack_tile(uint tile) { return ivec2(tile & 0xFFFFu, tile >> 16); }

// Share of the tiles under a silhouette in which something may be seen, estimated from the first few of them: 0 only if
// certainly nothing can. Counting all of them takes half as long again and saves 1 % of the points.
float open_share(Silhouette silhouette) {
  ivec2 low = unpack_tile(silhouette.low);
  ivec2 high = unpack_tile(silhouette.high);
  const int kEnough = 4;
  ivec2 tiles = high - low + 1;
  uvec4 level = levels[max(silhouette.level, 1u) - 1u];
  int open = 0;
  int seen = 0;
  ivec2 at = low;
  while (seen < tiles.x * tiles.y && open < kEnough) {
    float farthest_there = silhouette.level == 0u ? drawn_at(at) : farthest[level.x + uint(at.y) * level.y + uint(at.x)];
    if (farthest_there <= silhouette.depth) ++open;
    ++seen;
    at.x = at.x < high.x ? at.x + 1 : low.x;
    if (at.x == low.x) ++at.y;
  }
  return float(open) / float(seen);
}

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  if (!all) i = open_clusters[i];
#ifdef TWO_EYES
  float open = open_share(silhouettes[first_silhouette + i]);
  if (decides) open = max(open, prospects[i].open);
  bool hidden = decides && open == 0.0;
#else
  float open = open_share(silhouettes[i]);
  bool hidden = open == 0.0;
#endif
  if (hidden && states[i].status == kOpen) {
    states[i].status = kOccluded;
    atomicAdd(sight.occluded, 1u);
  }
  prospects[i].open = open;
}
