// Prefix sums over all clusters of what is taken, in two steps: sums of the work groups of select_take (SCAN_SUMS, with the same
// groups), then, in one invocation, the sums before each group.
#include "clusters.glsl"
#ifdef SCAN_SUMS
layout(local_size_x = GROUP) in;
#include "invocation.glsl"
#include "wishes.glsl"

shared uvec4 sums[GROUP];

void main() {
  uint i = invocation_index();
  uint lane = gl_LocalInvocationID.x;
  sums[lane] = wish_of(i);
  for (uint step = GROUP / 2u; step > 0u; step /= 2u) {
    barrier();
    if (lane < step) sums[lane] += sums[lane + step];
  }
  if (lane == 0u && i < clusters) group_sums[i / GROUP] = sums[0];
}

#else
layout(local_size_x = 1) in;

layout(std430, binding = 6) buffer GroupSums { uvec4 group_sums[]; };
layout(location = 0) uniform uint groups;

void main() {
  uvec4 before = uvec4(0u);
  for (uint g = 0u; g < groups; ++g) {
    uvec4 here = group_sums[g];
    group_sums[g] = before;
    before += here;
  }
}
#endif
