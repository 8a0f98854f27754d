// Counts the pixels that show a point.
#include "packing.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) buffer Covered { uint covered; };

shared uint group_count;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (gl_LocalInvocationIndex == 0u) group_count = 0u;
  barrier();
  if (all(lessThan(pixel, textureSize(target_ids, 0))) && texelFetch(target_ids, pixel, 0).x != kNoPoint)
    atomicAdd(group_count, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u) atomicAdd(covered, group_count);
}
