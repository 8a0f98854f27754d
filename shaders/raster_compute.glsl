// The compute rasterizer. PASS_DEPTH: nearest depth of every pixel. PASS_CLAIM: lowest id at that depth, and its point.
// PASS_REPEAT: winners write again, when there were more ties than notes.
#include "projection.glsl"
#include "point_source.glsl"
layout(local_size_x = 128) in;
#include "invocation.glsl"

layout(r32ui, binding = 0) uniform uimage2D target_depth;
#ifndef PASS_DEPTH
layout(r32ui, binding = 1) uniform uimage2D target_ids;
layout(rgba32i, binding = 2) uniform writeonly iimage2D target_points;
#include "ties.glsl"
#endif

void cover(ivec2 pixel, uint depth, ivec4 point, uint id) {
#if defined(PASS_DEPTH)
  // Reversed depth is positive, so its bits order as its values do
  if (depth > imageLoad(target_depth, pixel).x) imageAtomicMax(target_depth, pixel, depth);
#elif defined(PASS_CLAIM)
  if (imageLoad(target_depth, pixel).x != depth) return;
  uint before = imageAtomicMin(target_ids, pixel, id);
  if (before <= id) return;
  imageStore(target_points, pixel, point);
  if (before != kNoPoint) note_tie(point, id, pixel);
#else
  if (imageLoad(target_ids, pixel).x == id && imageLoad(target_depth, pixel).x == depth)
    imageStore(target_points, pixel, point);
#endif
}

void draw(uint i) {
  ivec4 point;
  uint id;
  vec3 place;
  if (!fetch_point(i, point, id) || !project(point.xyz, place)) return;
  uint depth = floatBitsToUint(place.z);
  if (view.point_size == 1.0) {
    cover(ivec2(place.xy), depth, point, id);
    return;
  }
  // Pixels whose centre lies in the square around the place
  float half_size = 0.5 * view.point_size;
  ivec2 low = max(ivec2(floor(place.xy - half_size + 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(place.xy + half_size - 0.5)), view.size - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) cover(ivec2(x, y), depth, point, id);
}

void main() {
#ifdef PASS_REPEAT
#ifdef SOURCE_GRID
  uint count = uint(view.size.x * view.size.y);
#else
  uint count = source_count();
#endif
  for (uint i = gl_GlobalInvocationID.x; i < count; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) draw(i);
#else
  draw(invocation_index());
#endif
}
