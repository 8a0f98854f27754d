// Counts the pixels that show a point.
#include "column.glsl"

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) buffer Covered { uint covered; };

void main() {
  uint shown = shown_in_column(target_ids);
  if (shown != 0u) atomicAdd(covered, uint(bitCount(shown)));
}
