// S19's prepare pass: the visible points of a finished frame become whole vertices in a buffer, drawn first in the next
// frame. An invocation takes room for several at once: to do so for a work group would take barriers, which cost more.
#include "vertex_list.glsl"
#include "column.glsl"

layout(binding = 0) uniform isampler2D previous_points;
layout(binding = 1) uniform usampler2D previous_ids;

void main() {
  uint shown = shown_in_column(previous_ids);
  if (shown == 0u) return;
  uint place = atomicAdd(list_command.count, uint(bitCount(shown)));
  for (; shown != 0u; shown &= shown - 1u) {
    ivec2 pixel = first_shown(shown);
    put_into_list(place++, texelFetch(previous_points, pixel, 0), texelFetch(previous_ids, pixel, 0).x);
  }
}
