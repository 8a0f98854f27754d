// S19's attribute streaming: new colours, 4 bytes a point in the order of ids, reach points that stay where they are; in a
// buffer, or (PICTURE) in the pixels of a finished frame.
layout(std430, binding = 0) readonly buffer Colors { uint colors[]; };
layout(location = 0) uniform uint first;  // id whose colour is colors[0]
layout(location = 1) uniform uint count;  // colours

#ifdef PICTURE
#include "packing.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0, rgba32i) uniform iimage2D points;
layout(binding = 1, r32ui) uniform uimage2D ids;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(ids)))) return;
  // Ids below the first wrap around to beyond the last; kNoPoint always is
  uint at = imageLoad(ids, pixel).x - first;
  if (at >= count) return;
  int color = int(colors[at]);
  imageStore(points, pixel, ivec4(imageLoad(points, pixel).xyz, color));
  // A point that is not to be seen any more is not carried on
  if (color >= 0) imageStore(ids, pixel, uvec4(kNoPoint));
}

#else

layout(local_size_x = 128) in;
#include "invocation.glsl"

layout(std430, binding = 1) buffer Points { ivec4 points[]; };
layout(std430, binding = 2) readonly buffer Ids { uint ids[]; };
layout(location = 2) uniform uint size;  // points

void main() {
  uint i = invocation_index();
  if (i >= size) return;
  uint at = ids[i] - first;
  if (at < count) points[i].w = int(colors[at]);
}

#endif
