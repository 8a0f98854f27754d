// A finished frame's colours, stretched to the picture; with SPLIT those of two frames, left and right of a divider. With PACKED
// they come from a pass over the frame (eye_dome.glsl, say), 0 where no point is.
#include "packing.glsl"

#ifdef PACKED
layout(binding = 0) uniform usampler2D left;
#ifdef SPLIT
layout(binding = 2) uniform usampler2D right;
#endif
#else
layout(binding = 0) uniform isampler2D left;  // points
layout(binding = 1) uniform usampler2D left_ids;
#ifdef SPLIT
layout(binding = 2) uniform isampler2D right;
layout(binding = 3) uniform usampler2D right_ids;
#endif
#endif
layout(location = 0) uniform vec3 background;
layout(location = 1) uniform ivec2 size;       // of the picture
layout(location = 2) uniform bool upside_down; // row 0 is the lowest one, as in a window
layout(location = 3) uniform int divider;      // first column of the right frame
layout(location = 4) uniform int first_column; // of the picture in the framebuffer

layout(location = 0) out vec4 color;

vec4 unpacked(uint rgba) { return vec4(vec3((uvec3(rgba) >> uvec3(0, 8, 16)) & 255u) / 255.0, 1.0); }

#ifdef PACKED
vec4 color_at(usampler2D colors, ivec2 pixel) {
  uint rgba = texelFetch(colors, pixel * textureSize(colors, 0) / size, 0).x;
  return rgba == 0u ? vec4(background, 1.0) : unpacked(rgba);
}
#define LEFT left
#define RIGHT right
#else
vec4 color_at(isampler2D points, usampler2D ids, ivec2 pixel) {
  pixel = pixel * textureSize(ids, 0) / size;
  if (texelFetch(ids, pixel, 0).x == kNoPoint) return vec4(background, 1.0);
  return unpacked(uint(texelFetch(points, pixel, 0).w));
}
#define LEFT left, left_ids
#define RIGHT right, right_ids
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(first_column, 0);
  if (upside_down) pixel.y = size.y - 1 - pixel.y;
#ifdef SPLIT
  if (pixel.x >= divider) {
    color = color_at(RIGHT, pixel);
    return;
  }
#endif
  color = color_at(LEFT, pixel);
}
