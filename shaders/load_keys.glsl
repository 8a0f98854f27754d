// The keys of a picture that is drawn over.
#extension GL_ARB_gpu_shader_int64 : require
#include "pixel_keys.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(r32ui, binding = 0) uniform readonly uimage2D target_depth;
layout(r32ui, binding = 1) uniform readonly uimage2D target_ids;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(target_ids);
  if (any(greaterThanEqual(pixel, size))) return;
  // kNoPoint and no depth make 0
  pixel_keys[pixel.y * size.x + pixel.x] = key_of(imageLoad(target_depth, pixel).x, imageLoad(target_ids, pixel).x);
}
