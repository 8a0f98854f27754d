// The farthest depth of each tile of 2 x 2, from the finished frame or from the level below. Reversed depth: the least value is
// the farthest, and 0 where nothing is.
layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = 3) buffer Pyramid { float farthest[]; };
layout(location = 0) uniform uvec3 level;  // first value, width, height
#if defined(FROM_IMAGE)
layout(binding = 0) uniform usampler2D depth;
#elif defined(FROM_ATTACHMENT)
layout(binding = 0) uniform sampler2D depth;
#else
layout(location = 1) uniform uvec3 below;
#endif
layout(location = 2) uniform ivec2 size_below;

float depth_at(ivec2 place) {
  place = min(place, size_below - 1);
#if defined(FROM_IMAGE)
  return uintBitsToFloat(texelFetch(depth, place, 0).x);
#elif defined(FROM_ATTACHMENT)
  return texelFetch(depth, place, 0).x;
#else
  return farthest[below.x + uint(place.y) * below.y + uint(place.x)];
#endif
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(level.yz)))) return;
  ivec2 place = 2 * tile;
  farthest[level.x + uint(tile.y) * level.y + uint(tile.x)] =
      min(min(depth_at(place), depth_at(place + ivec2(1, 0))), min(depth_at(place + ivec2(0, 1)), depth_at(place + 1)));
}
