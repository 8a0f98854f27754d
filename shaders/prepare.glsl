// S19's prepare pass: the visible points of a finished frame become whole vertices in a buffer, drawn first in the next
// frame. An invocation takes room for all of a column and then turns to those alone: barriers would cost more.
#include "vertex_list.glsl"
#include "column.glsl"

layout(binding = 0) uniform isampler2D previous_points;
layout(binding = 1) uniform usampler2D previous_ids;

void main() {
  ivec2 first = first_of_column();
  int rows = rows_of_column(textureSize(previous_ids, 0));
  uint shown = 0u;  // a bit a row
  for (int y = 0; y < rows; ++y) shown |= uint(texelFetch(previous_ids, first + ivec2(0, y), 0).x != kNoPoint) << y;
  if (shown == 0u) return;
  uint place = atomicAdd(list_command.count, uint(bitCount(shown)));
  for (; shown != 0u; shown &= shown - 1u) {
    ivec2 pixel = first + ivec2(0, findLSB(shown));
    put_into_list(place++, texelFetch(previous_points, pixel, 0), texelFetch(previous_ids, pixel, 0).x);
  }
}
