// A finished frame's colours, stretched to the picture; with SPLIT those of two frames, left and right of a divider.
#include "packing.glsl"

layout(binding = 0) uniform isampler2D points;
layout(binding = 1) uniform usampler2D ids;
#ifdef SPLIT
layout(binding = 2) uniform isampler2D right_points;
layout(binding = 3) uniform usampler2D right_ids;
#endif
layout(location = 0) uniform vec3 background;
layout(location = 1) uniform ivec2 size;       // of the picture
layout(location = 2) uniform bool upside_down; // row 0 is the lowest one, as in a window
layout(location = 3) uniform int divider;      // first column of the right frame

layout(location = 0) out vec4 color;

vec3 color_at(isampler2D frame_points, usampler2D frame_ids, ivec2 pixel) {
  pixel = pixel * textureSize(frame_ids, 0) / size;
  if (texelFetch(frame_ids, pixel, 0).x == kNoPoint) return background;
  return vec3((ivec3(texelFetch(frame_points, pixel, 0).w) >> ivec3(0, 8, 16)) & 255) / 255.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (upside_down) pixel.y = size.y - 1 - pixel.y;
#ifdef SPLIT
  if (pixel.x >= divider) {
    color = vec4(color_at(right_points, right_ids, pixel), 1.0);
    return;
  }
#endif
  color = vec4(color_at(points, ids, pixel), 1.0);
}
