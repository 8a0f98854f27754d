// Counts the pixels that show a point: an invocation a column of some rows, as barriers cost more than pixels do.
#include "packing.glsl"
layout(local_size_x = 64) in;

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) buffer Covered { uint covered; };

const int kRows = 16;

void main() {
  ivec2 size = textureSize(target_ids, 0);
  int x = int(gl_GlobalInvocationID.x);
  if (x >= size.x) return;
  int first = int(gl_WorkGroupID.y) * kRows;
  uint count = 0u;
  for (int y = first; y < min(first + kRows, size.y); ++y) count += uint(texelFetch(target_ids, ivec2(x, y), 0).x != kNoPoint);
  if (count > 0u) atomicAdd(covered, count);
}
