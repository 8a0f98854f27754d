// S19's prepare pass: the visible points of a finished frame become whole vertices in a buffer, drawn first in the next
// frame. A work group collects its own pixels before it takes room in the buffer.
#include "vertex_list.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform isampler2D previous_points;
layout(binding = 1) uniform usampler2D previous_ids;

shared uint group_count;
shared uint group_first;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool inside = all(lessThan(pixel, textureSize(previous_ids, 0)));
  uint id = inside ? texelFetch(previous_ids, pixel, 0).x : kNoPoint;

  if (gl_LocalInvocationIndex == 0u) group_count = 0u;
  barrier();
  uint place = 0u;
  if (id != kNoPoint) place = atomicAdd(group_count, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u) group_first = atomicAdd(list_command.count, group_count);
  barrier();
  if (id != kNoPoint) put_into_list(group_first + place, texelFetch(previous_points, pixel, 0), id);
}
