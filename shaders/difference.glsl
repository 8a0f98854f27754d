// A finished frame against the reference of the same view: colours that show where they differ, and the sum of squared errors.
#include "packing.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform isampler2D points;
layout(binding = 1) uniform usampler2D ids;
layout(binding = 2) uniform usampler2D reference;  // packed colours, 0 where no point is
layout(r32ui, binding = 0) uniform writeonly uimage2D colors;
// A group's sum has 25 bits: in two parts, the sums over all groups of a picture of 8192 x 8192 fit into 32.
layout(std430, binding = 0) buffer Sums { uint low_sum; uint high_sum; };
layout(location = 0) uniform ivec3 background;

const uint kLowBits = 12u;

shared uint group_sum;

ivec3 channels(uint rgba) { return (ivec3(int(rgba)) >> ivec3(0, 8, 16)) & 255; }

uint packed_color(vec3 c) {
  uvec3 byte = uvec3(clamp(c, 0.0, 255.0) + 0.5);
  return byte.x | byte.y << 8 | byte.z << 16 | 0xFF000000u;
}

// Missing points magenta, points where none should be cyan, other colours from brown to yellow, right ones dim.
uint shown(bool covered, bool wanted, ivec3 color, ivec3 right) {
  if (!covered && !wanted) return 0u;
  if (!covered) return packed_color(vec3(230.0, 40.0, 200.0));
  if (!wanted) return packed_color(vec3(40.0, 210.0, 230.0));
  ivec3 off = abs(color - right);
  float error = float(max(off.x, max(off.y, off.z))) / 255.0;
  if (error == 0.0) return packed_color(vec3(dot(vec3(right), vec3(0.06, 0.12, 0.02))));
  return packed_color(mix(vec3(110.0, 60.0, 0.0), vec3(255.0, 225.0, 60.0), sqrt(error)));
}

void main() {
  if (gl_LocalInvocationIndex == 0u) group_sum = 0u;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, textureSize(ids, 0)))) {
    bool covered = texelFetch(ids, pixel, 0).x != kNoPoint;
    uint wanted = texelFetch(reference, pixel, 0).x;
    ivec3 color = covered ? channels(uint(texelFetch(points, pixel, 0).w)) : background;
    ivec3 right = wanted != 0u ? channels(wanted) : background;
    ivec3 off = color - right;
    atomicAdd(group_sum, uint(off.x * off.x + off.y * off.y + off.z * off.z));
    imageStore(colors, pixel, uvec4(shown(covered, wanted != 0u, color, right)));
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u || group_sum == 0u) return;
  atomicAdd(low_sum, group_sum & ((1u << kLowBits) - 1u));
  atomicAdd(high_sum, group_sum >> kLowBits);
}
