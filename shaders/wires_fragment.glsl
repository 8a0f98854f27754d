// Lines are faint where they are behind what the frame shows.
layout(location = 1) uniform float near;        // world units
layout(location = 2) uniform ivec2 size;        // of the picture
layout(location = 3) uniform ivec2 columns;     // first, and the one after the last
layout(location = 4) uniform bool from_below;   // row 0 is the lowest one, as in a window
layout(location = 5) uniform int first_column;  // of the picture in the framebuffer
#ifdef FROM_ATTACHMENT
layout(binding = 0) uniform sampler2D depth;
float closeness_at(ivec2 pixel) { return texelFetch(depth, pixel, 0).x; }
#else
layout(binding = 0) uniform usampler2D depth;
float closeness_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth, pixel, 0).x); }
#endif

layout(location = 0) flat in vec3 vertex_color;
layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(first_column, 0);
  if (pixel.x < columns.x || pixel.x >= columns.y) discard;
  if (from_below) pixel.y = size.y - 1 - pixel.y;
  bool behind = near * gl_FragCoord.w < closeness_at(pixel * textureSize(depth, 0) / size);
  color = vec4(vertex_color, behind ? 0.15 : 0.85);
}
