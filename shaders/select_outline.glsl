// For each cluster, once a view: can the view see it, which pixels may it touch, what is there to win.
#include "projection.glsl"
#include "clusters.glsl"
#include "outline.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 2) readonly buffer Densities { float log_pixels[]; };  // kLevels a cluster
layout(std430, binding = 4) readonly buffer OpenClusters { uint open_clusters[]; };
layout(std430, binding = 5) buffer InSight { Sight sight; };
layout(std430, binding = 6) writeonly buffer Silhouettes { Silhouette silhouettes[]; };
layout(std430, binding = 7) writeonly buffer Prospects { Prospect prospects[]; };

layout(location = 0) uniform uint count;         // clusters to do
layout(location = 1) uniform uint first;         // of the open clusters
layout(location = 2) uniform bool all;           // not of the open clusters, but of all
layout(location = 4) uniform float root_edge;    // world units
layout(location = 7) uniform bool culls;         // what is outside of the frustum
#ifdef TWO_EYES
layout(location = 5) uniform uint second_silhouettes;  // place of the first of the second eye's
layout(location = 6) uniform vec3 to_second_eye;       // from the first, whose view is bound; world units
#endif

// octree/select/density.h, whose results at whole levels are tabulated.
float estimated_pixels(uint cluster, float distance) {
  float pixel = 2.0 * max(distance, view.near) / (length(view.down.xyz) * float(view.size.y));
  float level = clamp(log2(root_edge / pixel), 0.0, float(LEVELS - 1));
  uint whole = min(uint(level), LEVELS - 2);
  uint at = cluster * LEVELS + whole;
  return exp2(mix(log_pixels[at], log_pixels[at + 1u], level - float(whole)));
}

// What is outside and is not culled may be seen, for all that is known.
Outline outline_to_test(vec3 low, vec3 high, vec3 reach) {
  Outline outline = outline_of(low, high, reach);
  if (outline.outside && !culls) outline.outside = outline.bounded = false;
  return outline;
}

void main() {
  uint i = invocation_index();
  if (i >= count) return;
  if (!all) i = open_clusters[first + i];
  ClusterBox box = boxes[i];
  ClusterState state = states[i];
  // Go on where the last view ended: the points it showed are carried
  state.start += state.drawn;
  if (state.start >= box.count) state.start -= box.count;
  state.drawn = 0u;
  state.hidden = uvec4(0u);
  // What the last view taught fades, but tells new clusters from those that are carried or hidden: along a path that is worth
  // 0.5 to 1 dB, and fading faster or slower is worth less
  const float kFading = 0.9;
  state.seen = state.status == kOutside ? 1.0 : mix(state.status == kOccluded ? 0.0 : state.seen, 1.0, kFading);
  vec3 low = world_from_eye(box.low);
  vec3 high = world_from_eye(box.high);
  vec3 reach = max(abs(low), abs(high));
  Outline outline = outline_to_test(low, high, reach);
  bool outside = outline.outside;
#ifdef TWO_EYES
  Outline second = outline_to_test(low - to_second_eye, high - to_second_eye, reach + abs(to_second_eye));
  silhouettes[second_silhouettes + i] = silhouette_of(second);
  outside = outside && second.outside;
#endif
  // Rows without points are free
  state.status = outside || box.count == 0u ? kOutside : kOpen;
  states[i] = state;
  if (state.status == kOpen) atomicAdd(sight.visible, 1u);
  silhouettes[i] = silhouette_of(outline);
  prospects[i] = Prospect(estimated_pixels(i, outline.nearest), max(outline.nearest, view.near), 1.0);
}
