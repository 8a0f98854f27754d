// For each cluster, or each that is open still: can this view see it, is it wholly behind the depth already drawn, and if
// neither, what is there to win. Only certainty rules a cluster out.
#include "projection.glsl"
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 2) readonly buffer Densities { float log_pixels[]; };  // kLevels a cluster
layout(std430, binding = 3) readonly buffer Pyramid { float farthest[]; };
#ifdef FROM_ATTACHMENT
layout(binding = 0) uniform sampler2D depth_drawn;
float drawn_at(ivec2 pixel) { return texelFetch(depth_drawn, pixel, 0).x; }
#else
layout(binding = 0) uniform usampler2D depth_drawn;
float drawn_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth_drawn, pixel, 0).x); }
#endif
layout(std430, binding = 4) readonly buffer OpenClusters { uint open_clusters[]; };
layout(std430, binding = 7) writeonly buffer Prospects { Prospect prospects[]; };

layout(location = 0) uniform uint tested;         // all clusters, or as many as are open
layout(location = 1) uniform bool new_view;       // test all
layout(location = 3) uniform int pyramid_levels;  // 0: nothing is known of the depth
layout(location = 4) uniform float root_edge;     // world units
layout(location = 5) uniform uvec4 levels[16];    // of the pyramid: first value, width, height

// Rounding of projected coordinates, of the magnitudes that went into them: float has 6e-8, a few times.
const float kRounding = 4e-6;
// Of a depth, in whatever way a rasterizer computes it.
const float kDepthRounding = 1e-5;
// Tiles a cluster's outline is looked up in, along each axis.
const int kTiles = 8;

struct Outline {
  bool outside;   // of the frustum
  bool bounded;   // wholly beyond the near plane; else the rest means nothing
  vec2 low;       // pixels
  vec2 high;
  float nearest;  // distance along the line of sight, world units
};

Outline outline_of(ClusterBox box) {
  vec3 low = world_from_eye(box.low);
  vec3 high = world_from_eye(box.high);
  vec3 reach = max(abs(low), abs(high));
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
  // Rasterizers may snap points to sixteenths of a pixel, the coarsest that OpenGL allows
  vec2 margin = 0.125 + 0.5 * max(view.point_size - 1.0, 0.0) + 0.5 * vec2(view.size) * (slack.xy + most * slack.z) / outline.nearest;
  outline.low = (from * 0.5 + 0.5) * vec2(view.size) - margin;
  outline.high = (to * 0.5 + 0.5) * vec2(view.size) + margin;
  return outline;
}

// Share of the tiles under the outline in which something of the box may be seen: 0 only if certainly nothing can.
float open_share(Outline outline) {
  if (!outline.bounded || pyramid_levels == 0) return 1.0;
  ivec2 low = ivec2(clamp(outline.low, vec2(0.0), vec2(view.size - 1)));
  ivec2 high = ivec2(clamp(outline.high, vec2(0.0), vec2(view.size - 1)));
  float depth = view.near / outline.nearest * (1.0 + kDepthRounding);
  int level = 0;  // tiles of 2^level pixels
  while (level < pyramid_levels && any(greaterThanEqual((high >> level) - (low >> level), ivec2(kTiles)))) ++level;
  low >>= level;
  high >>= level;
  int open = 0;
  if (level == 0) {
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (drawn_at(ivec2(x, y)) <= depth) ++open;
  } else {
    uvec4 tiles = levels[level - 1];
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (farthest[tiles.x + uint(y) * tiles.y + uint(x)] <= depth) ++open;
  }
  ivec2 tiles = high - low + 1;
  return float(open) / float(tiles.x * tiles.y);
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
  if (i >= tested) return;
  if (!new_view) i = open_clusters[i];
  ClusterBox box = boxes[i];
  ClusterState state = states[i];
  if (new_view) {
    // Go on where the last view ended: the points it showed are carried
    state.start += state.drawn;
    if (state.start >= box.count) state.start -= box.count;
    state.drawn = 0u;
    state.status = kOpen;
    state.seen = 1.0;
  }
  Outline outline = outline_of(box);
  float open = open_share(outline);
  if (outline.outside || box.count == 0u) state.status = kOutside;  // rows without points are free
  else if (open == 0.0) state.status = kOccluded;
  states[i] = state;
  prospects[i] = Prospect(estimated_pixels(i, outline.nearest), max(outline.nearest, view.near), open);
}
