// An invocation for some pixels one above the other (dispatch_columns), of which it works off those that show a point:
// others cost next to nothing.
#include "packing.glsl"
layout(local_size_x = 64) in;

ivec2 column() { return ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * 16u); }

// Those of its rows that show a point, a bit each.
uint shown_in_column(usampler2D ids) {
  ivec2 size = textureSize(ids, 0);
  ivec2 first = column();
  int rows = first.x < size.x ? min(16, size.y - first.y) : 0;
  uint shown = 0u;
  for (int y = 0; y < rows; ++y) shown |= uint(texelFetch(ids, first + ivec2(0, y), 0).x != kNoPoint) << y;
  return shown;
}

ivec2 first_shown(uint shown) { return column() + ivec2(0, findLSB(shown)); }
