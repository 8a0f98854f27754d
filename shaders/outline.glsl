// Which pixels and tiles a box may touch, and how near it comes. After projection.glsl and clusters.glsl.

// Rounding of projected coordinates, of the magnitudes that went into them: float has 6e-8, a few times.
const float kRounding = 4e-6;
// Of a depth, in whatever way a rasterizer computes it.
const float kDepthRounding = 1e-5;
// Of a place in pixels, in pictures of up to 16,384.
const float kPlaceRounding = 0.01;
// Tiles a box is looked up in, along each axis.
const int kTiles = 8;

struct Outline {
  bool outside;   // of the frustum
  bool bounded;   // wholly beyond the near plane; else the rest means nothing
  vec2 low;       // pixels
  vec2 high;
  float nearest;  // distance along the line of sight, world units
};

// From what was found of a box: how far it reaches to the inner side of the frustum's four planes, its nearest and its farthest
// place along the line of sight, and what it covers of the picture from -1 to 1; no rounding may make any of it too small.
Outline outline_from(vec4 inwards, float nearest, float farthest, vec2 ndc_low, vec2 ndc_high) {
  Outline outline;
  outline.outside = any(lessThan(inwards, vec4(0.0))) || farthest < view.near;
  outline.nearest = nearest;
  outline.bounded = nearest > view.near;
  // The nearest of its points are the largest
  float largest = max(view.point_size, splat_diameter(view.near / nearest * (1.0 + kDepthRounding)));
  float margin = kPlaceRounding + view.snapping + 0.5 * max(largest - 1.0, 0.0);
  outline.low = (ndc_low * 0.5 + 0.5) * vec2(view.size) - margin;
  outline.high = (ndc_high * 0.5 + 0.5) * vec2(view.size) + margin;
  return outline;
}

// Of a box from low to high, world units from an eye that looks in the direction of the bound view: by its corners. `reach`: the
// largest magnitudes that went into these, an axis each, which is what they are rounded by.
Outline outline_of(vec3 low, vec3 high, vec3 reach) {
  vec3 slack = kRounding * vec3(dot(abs(view.right.xyz), reach), dot(abs(view.down.xyz), reach),
                                dot(abs(view.forward.xyz), reach));
  const float kInfinity = uintBitsToFloat(0x7F800000u);
  vec4 inwards = vec4(-kInfinity);
  float nearest = kInfinity;
  float farthest = -kInfinity;
  vec2 from = vec2(kInfinity);
  vec2 to = vec2(-kInfinity);
  for (int corner = 0; corner < 8; ++corner) {
    vec3 r = mix(low, high, vec3(corner & 1, corner >> 1 & 1, corner >> 2));
    vec3 clip = vec3(dot(view.right.xyz, r), dot(view.down.xyz, r), dot(view.forward.xyz, r));
    inwards = max(inwards, clip.z + vec4(clip.x, -clip.x, clip.y, -clip.y));
    nearest = min(nearest, clip.z);
    farthest = max(farthest, clip.z);
    vec2 ndc = clip.xy / clip.z;
    from = min(from, ndc);
    to = max(to, ndc);
  }
  nearest -= slack.z;
  vec2 ndc_slack = (slack.xy + max(abs(from), abs(to)) * slack.z) / nearest;
  return outline_from(inwards + slack.xxyy + slack.z, nearest, farthest + slack.z, from - ndc_slack, to + ndc_slack);
}

// The least and the largest of numbers in [low, high], divided by numbers in [nearest, farthest], both above zero.
vec2 least_ratio(vec2 low, float nearest, float farthest) {
  return low / mix(vec2(farthest), vec2(nearest), lessThan(low, vec2(0.0)));
}
vec2 largest_ratio(vec2 high, float nearest, float farthest) {
  return high / mix(vec2(nearest), vec2(farthest), lessThan(high, vec2(0.0)));
}

// The same in less time, by how far the box reaches along the axes of the view: nearly as tight for a box that is small for its
// distance.
Outline outline_of_small(vec3 low, vec3 high, vec3 reach) {
  vec3 centre = 0.5 * (low + high);
  vec3 half_edge = 0.5 * (high - low) + kRounding * reach;
  vec3 at = vec3(dot(view.right.xyz, centre), dot(view.down.xyz, centre), dot(view.forward.xyz, centre));
  vec3 around = vec3(dot(abs(view.right.xyz), half_edge), dot(abs(view.down.xyz), half_edge),
                     dot(abs(view.forward.xyz), half_edge));
  vec3 from = at - around;
  vec3 to = at + around;
  vec4 inwards = to.z + vec4(to.x, -from.x, to.y, -from.y);
  return outline_from(inwards, from.z, to.z, least_ratio(from.xy, from.z, to.z),
                      largest_ratio(to.xy, from.z, to.z));
}

layout(location = 3) uniform int most_levels;  // of the pyramid

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
