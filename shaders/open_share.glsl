// How much of what lies under a silhouette may be seen. After clusters.glsl.
layout(std430, binding = 3) readonly buffer Pyramid { float farthest[]; };
// Of the pixels (0, 1), (1, 1), (1, 0), (0, 0) from `pixel` on.
#ifdef FROM_ATTACHMENT
layout(binding = 0) uniform sampler2D depth_drawn;
vec4 drawn_at(ivec2 pixel) { return textureGather(depth_drawn, vec2(pixel + 1) / vec2(textureSize(depth_drawn, 0))); }
#else
layout(binding = 0) uniform usampler2D depth_drawn;
vec4 drawn_at(ivec2 pixel) {
  return uintBitsToFloat(textureGather(depth_drawn, vec2(pixel + 1) / vec2(textureSize(depth_drawn, 0))));
}
#endif
layout(location = 5) uniform uvec4 levels[16];  // of the pyramid: first value, width, height

uint count_of(bvec4 flags) {
  uvec4 ones = uvec4(flags);
  return ones.x + ones.y + ones.z + ones.w;
}

// Share of the tiles in which something may be seen, estimated from the first tiles of which `enough` are such: 0 only if
// certainly nothing can be seen in any.
float open_share(Silhouette silhouette, uint enough) {
  ivec2 low = unpack_tile(silhouette.low);
  ivec2 high = unpack_tile(silhouette.high);
  uvec4 level = levels[max(silhouette.level, 1u) - 1u];
  bool pixels = silhouette.level == 0u;
  uint open = 0u;
  uint seen = 0u;
  ivec2 at = low;
  while (pixels && at.y <= high.y && open < enough) {
    bool right = at.x < high.x;
    bool below = at.y < high.y;
    bvec4 inside = bvec4(below, right && below, right, true);
    bvec4 nearer = lessThanEqual(drawn_at(at), vec4(silhouette.depth));
    open += count_of(bvec4(uvec4(nearer) & uvec4(inside)));
    seen += count_of(inside);
    at.x += 2;
    if (at.x > high.x) at = ivec2(low.x, at.y + 2);
  }
  while (!pixels && at.y <= high.y && open < enough) {
    if (farthest[level.x + uint(at.y) * level.y + uint(at.x)] <= silhouette.depth) ++open;
    ++seen;
    if (++at.x > high.x) at = ivec2(low.x, at.y + 1);
  }
  return float(open) / float(seen);
}
