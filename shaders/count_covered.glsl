// Counts the pixels that show a point.
#include "packing.glsl"
#include "column.glsl"

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) buffer Covered { uint covered; };

void main() {
  ivec2 first = first_of_column();
  int rows = rows_of_column(textureSize(target_ids, 0));
  uint count = 0u;
  for (int y = 0; y < rows; ++y) count += uint(texelFetch(target_ids, first + ivec2(0, y), 0).x != kNoPoint);
  if (count > 0u) atomicAdd(covered, count);
}
