// A finished frame's colours; left and right of a divider those of two frames, where there are two.
#include "packing.glsl"

layout(binding = 0) uniform isampler2D left_points;
layout(binding = 1) uniform usampler2D left_ids;
layout(binding = 2) uniform isampler2D right_points;
layout(binding = 3) uniform usampler2D right_ids;
layout(location = 0) uniform vec3 background;
layout(location = 1) uniform int divider;      // first column of the right frame
layout(location = 2) uniform bool upside_down; // row 0 is the lowest one, as in a window

layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (upside_down) pixel.y = textureSize(left_ids, 0).y - 1 - pixel.y;
  bool right = pixel.x >= divider;
  uint id = right ? texelFetch(right_ids, pixel, 0).x : texelFetch(left_ids, pixel, 0).x;
  color = vec4(background, 1.0);
  if (id != kNoPoint) {
    int rgba = right ? texelFetch(right_points, pixel, 0).w : texelFetch(left_points, pixel, 0).w;
    color.rgb = vec3((ivec3(rgba) >> ivec3(0, 8, 16)) & 255) / 255.0;
  }
}
