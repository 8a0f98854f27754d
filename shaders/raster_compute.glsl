// The compute rasterizer. PASS_DEPTH: nearest depth of every pixel; OVER_PICTURE: whoever owned a
// pixel farther away does so no longer. PASS_CLAIM: lowest id at that depth, and its point.
// PASS_REPEAT: winners write again, when there were more ties than notes. SPLATS: points may be larger than a pixel.
#include "projection.glsl"
#include "point_source.glsl"
#ifdef SOURCE_GRID
layout(local_size_x = 16, local_size_y = 8) in;
#else
layout(local_size_x = 128) in;
#endif
#include "invocation.glsl"

layout(r32ui, binding = 0) uniform uimage2D target_depth;
#if !defined(PASS_DEPTH) || defined(OVER_PICTURE)
layout(r32ui, binding = 1) uniform uimage2D target_ids;
#endif
#ifndef PASS_DEPTH
layout(rgba32i, binding = 2) uniform writeonly iimage2D target_points;
#include "ties.glsl"
#endif

void cover(ivec2 pixel, uint depth, ivec4 point, uint id) {
#if defined(PASS_DEPTH)
  // Reversed depth is positive, so its bits order as its values do
  uint before = imageLoad(target_depth, pixel).x;
  if (depth <= before) return;
  imageAtomicMax(target_depth, pixel, depth);
#ifdef OVER_PICTURE
  if (before != 0u) imageStore(target_ids, pixel, uvec4(kNoPoint));
#endif
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

void draw(PointIndex index) {
  ivec4 point;
  uint id;
  vec3 place;
  if (!fetch_point(index, point, id) || !project(point.xyz, place)) return;
  uint depth = floatBitsToUint(place.z);
#ifdef SPLATS
  // Pixels whose centre lies in the square around the place
  float half_size = 0.5 * view.point_size;
  ivec2 low = max(ivec2(floor(place.xy - half_size + 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(place.xy + half_size - 0.5)), view.size - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) cover(ivec2(x, y), depth, point, id);
#else
  cover(ivec2(place.xy), depth, point, id);
#endif
}

void main() {
#ifndef PASS_REPEAT
#ifdef SOURCE_GRID
  draw(ivec2(gl_GlobalInvocationID.xy));
#else
  draw(invocation_index());
#endif
#else
  // A fixed number of groups works off whatever there is
  uint group_size = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
#ifdef SOURCE_GRID
  for (uint y = gl_WorkGroupID.x; y < uint(view.size.y); y += gl_NumWorkGroups.x)
    for (uint x = gl_LocalInvocationIndex; x < uint(view.size.x); x += group_size) draw(ivec2(x, y));
#else
  for (uint i = gl_WorkGroupID.x * group_size + gl_LocalInvocationIndex; i < source_count();
       i += gl_NumWorkGroups.x * group_size)
    draw(i);
#endif
#endif
}
