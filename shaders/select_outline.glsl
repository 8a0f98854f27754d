// For each cluster, once a view: can the view see it, which pixels may it touch, what is there to win.
#include "projection.glsl"
#include "clusters.glsl"
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
layout(location = 3) uniform int most_levels;    // of the pyramid
layout(location = 4) uniform float root_edge;    // world units
#ifdef TWO_EYES
layout(location = 5) uniform uint second_silhouettes;  // place of the first of the second eye's
layout(location = 6) uniform vec3 to_second_eye;       // from the first, whose view is bound; world units
#endif

// Rounding of projected coordinates, of the magnitudes that went into them: float has 6e-8, a few times.
const float kRounding = 4e-6;
// Of a depth, in whatever way a rasterizer computes it.
const float kDepthRounding = 1e-5;
// Tiles a cluster is looked up in, along each axis.
const int kTiles = 8;

struct Outline {
  bool outside;   // of the frustum
  bool bounded;   // wholly beyond the near plane; else the rest means nothing
  vec2 low;       // pixels
  vec2 high;
  float nearest;  // distance along the line of sight, world units
};

// Seen from `aside` of the eye whose view is bound, world units, in the same direction.
Outline outline_of(ClusterBox box, vec3 aside) {
  vec3 low = world_from_eye(box.low) - aside;
  vec3 high = world_from_eye(box.high) - aside;
  vec3 reach = max(abs(low), abs(high)) + abs(aside);
  vec3 slack = kRounding * vec3(dot(abs(view.right.xyz), reach), dot(abs(view.down.xyz), reach),
                                dot(abs(view.forward.xyz), reach));
  const float kInfinity = uintBitsToFloat(0x7F800000u);
  vec4 inwards = vec4(-kInfinity);
  float nearest = kInfinity;
  float farthest_corner = -kInfinity;
  vec2 from = vec2(kInfinity);
  vec2 to = vec2(-kInfinity);
  for (int corner = 0; corner < 8; ++corner) {
    vec3 r = mix(low, high, vec3(corner & 1, corner >> 1 & 1, corner >> 2));
    vec3 clip = vec3(dot(view.right.xyz, r), dot(view.down.xyz, r), dot(view.forward.xyz, r));
    inwards = max(inwards, vec4(clip.z + clip.x, clip.z - clip.x, clip.z + clip.y, clip.z - clip.y));
    nearest = min(nearest, clip.z);
    farthest_corner = max(farthest_corner, clip.z);
    vec2 ndc = clip.xy / clip.z;
    from = min(from, ndc);
    to = max(to, ndc);
  }
  Outline outline;
  outline.outside = any(lessThan(inwards, -(slack.xxyy + slack.z))) || farthest_corner + slack.z < view.near;
  outline.nearest = nearest - slack.z;
  outline.bounded = outline.nearest > view.near;
  vec2 most = max(abs(from), abs(to));
  // The nearest of its points are the largest
  float largest = max(view.point_size, splat_diameter(view.near / outline.nearest * (1.0 + kDepthRounding)));
  // Rasterizers may snap points to sixteenths of a pixel, the coarsest that OpenGL allows
  vec2 margin = 0.125 + 0.5 * max(largest - 1.0, 0.0) + 0.5 * vec2(view.size) * (slack.xy + most * slack.z) / outline.nearest;
  outline.low = (from * 0.5 + 0.5) * vec2(view.size) - margin;
  outline.high = (to * 0.5 + 0.5) * vec2(view.size) + margin;
  return outline;
}

uint pack_tile(ivec2 tile) { return uint(tile.x) | uint(tile.y) << 16; }

Silhouette silhouette_of(Outline outline) {
#ifdef TWO_EYES
  // Only the other eye may see it: hidden here by whatever is drawn, and by nothing
  if (outline.outside) return Silhouette(0u, 0u, -1.0, 0u);
#endif
  // In front of everything: never hidden
  if (!outline.bounded) return Silhouette(0u, 0u, uintBitsToFloat(0x7F800000u), 0u);
  ivec2 low = ivec2(clamp(outline.low, vec2(0.0), vec2(view.size - 1)));
  ivec2 high = ivec2(clamp(outline.high, vec2(0.0), vec2(view.size - 1)));
  int level = 0;  // tiles of 2^level pixels
  while (level < most_levels && any(greaterThanEqual((high >> level) - (low >> level), ivec2(kTiles)))) ++level;
  return Silhouette(pack_tile(low >> level), pack_tile(high >> level),
                    view.near / outline.nearest * (1.0 + kDepthRounding), uint(level));
}

// octree/select/density.h, whose results at whole levels are tabulated.
float estimated_pixels(uint cluster, float distance) {
  float pixel = 2.0 * max(distance, view.near) / (length(view.down.xyz) * float(view.size.y));
  float level = clamp(log2(root_edge / pixel), 0.0, float(LEVELS - 1));
  uint whole = min(uint(level), LEVELS - 2);
  uint at = cluster * LEVELS + whole;
  return exp2(mix(log_pixels[at], log_pixels[at + 1u], level - float(whole)));
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
  // What the last view taught fades, but tells new clusters from those that are carried or hidden: along a path that is worth
  // 0.5 to 1 dB, and fading faster or slower is worth less
  const float kFading = 0.9;
  state.seen = state.status == kOutside ? 1.0 : mix(state.status == kOccluded ? 0.0 : state.seen, 1.0, kFading);
  Outline outline = outline_of(box, vec3(0.0));
  bool outside = outline.outside;
#ifdef TWO_EYES
  Outline second = outline_of(box, to_second_eye);
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
