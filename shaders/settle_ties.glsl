// After the claim pass: every note whose id won its pixel writes it again, now alone.
#include "ties.glsl"
layout(local_size_x = 128) in;

layout(r32ui, binding = 1) uniform readonly uimage2D target_ids;
layout(rgba32i, binding = 2) uniform writeonly iimage2D target_points;

void main() {
  uint noted = min(tie_count, uint(ties.length()));
  for (uint i = gl_GlobalInvocationID.x; i < noted; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
    Tie tie = ties[i];
    ivec2 pixel = ivec2(tie.pixel & 0xFFFFu, tie.pixel >> 16);
    if (imageLoad(target_ids, pixel).x == tie.id) imageStore(target_points, pixel, tie.point);
  }
}
