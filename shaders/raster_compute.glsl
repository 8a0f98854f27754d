// The compute rasterizer. PASS_DEPTH: nearest depth of every pixel; OVER_PICTURE: whoever owned a
// pixel farther away does so no longer; COLLECT: points that may own a pixel go to a list, to claim it from there.
// PASS_CLAIM: lowest id at that depth, and its point.
// PASS_REPEAT: winners write again, when there were more ties than notes. SPLATS: points may be no single pixels.
// KEYS: the depth pass settles the id as well, in one 64-bit number a pixel; the claim pass then shows the winners.
#ifdef KEYS
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#include "pixel_keys.glsl"
#endif
#include "projection.glsl"
#include "point_source.glsl"
#ifdef SOURCE_GRID
#include "column.glsl"
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
#endif
#if !defined(PASS_DEPTH) && !defined(KEYS)
#include "ties.glsl"
#endif
#ifdef COLLECT
#include "vertex_list.glsl"
#endif

// Whether the point may own the pixel.
bool cover(ivec2 pixel, uint depth, ivec4 point, uint id) {
#if defined(KEYS) && defined(PASS_DEPTH)
  uint64_t key = key_of(depth, id);
  int place = pixel.y * view.size.x + pixel.x;
  return key > pixel_keys[place] && key > atomicMax(pixel_keys[place], key);
#elif defined(KEYS)
  if (key_of(depth, id) != pixel_keys[pixel.y * view.size.x + pixel.x]) return false;
  imageStore(target_depth, pixel, uvec4(depth));
  imageStore(target_ids, pixel, uvec4(id));
  imageStore(target_points, pixel, point);
  return true;
#elif defined(PASS_DEPTH)
  // Reversed depth is positive, so its bits order as its values do
  uint before = imageLoad(target_depth, pixel).x;
  if (depth > before) {
    imageAtomicMax(target_depth, pixel, depth);
#ifdef OVER_PICTURE
    if (before != 0u) imageStore(target_ids, pixel, uvec4(kNoPoint));
#endif
  }
  return depth >= before;
#elif defined(PASS_CLAIM)
  if (imageLoad(target_depth, pixel).x != depth) return false;
  uint before = imageAtomicMin(target_ids, pixel, id);
  if (before <= id) return false;
  imageStore(target_points, pixel, point);
  if (before != kNoPoint) note_tie(point, id, pixel);
  return true;
#else
  if (imageLoad(target_ids, pixel).x != id || imageLoad(target_depth, pixel).x != depth) return false;
  imageStore(target_points, pixel, point);
  return true;
#endif
}

// Whether the point may own one of its pixels.
bool draw(ivec4 point, uint id) {
  vec3 place;
  if (!project(point.xyz, place)) return false;
  uint depth = floatBitsToUint(place.z);
#ifdef SPLATS
  float diameter = splat_diameter(place.z);
  if (diameter == 0.0 && view.point_size == 1.0) return cover(ivec2(place.xy), depth, point, id);
  // Pixels whose centre lies in the square around the place
  float half_size = 0.5 * max(diameter, view.point_size);
  ivec2 low = max(ivec2(floor(place.xy - half_size + 0.5)), ivec2(0));
  ivec2 high = min(ivec2(floor(place.xy + half_size - 0.5)), view.size - 1);
  bool owns = false;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (diameter == 0.0 || in_splat(place.xy, diameter, ivec2(x, y)))
        owns = cover(ivec2(x, y), depth, point, id) || owns;
  return owns;
#else
  return cover(ivec2(place.xy), depth, point, id);
#endif
}

void draw(bool exists, ivec4 point, uint id) {
  bool owns = exists && draw(point, id);
#ifdef COLLECT
  if (owns) put_into_list(atomicAdd(list_command.count, 1u), point, id);
#endif
}

void draw(PointIndex index) {
  ivec4 point;
  uint id;
  bool exists = fetch_point(index, point, id);
  draw(exists, point, id);
}

void main() {
#ifdef PASS_REPEAT
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
#elif defined(SOURCE_GRID)
  for (uint shown = shown_in_column(previous_ids); shown != 0u; shown &= shown - 1u) draw(first_shown(shown));
#elif defined(SOURCE_PICKS)
  // Picks lie about in memory: an invocation fetches several before it draws one, so that it waits for all at once
  const uint kPicksAtOnce = 4u;
  uint first = (invocation_index() - gl_LocalInvocationID.x) * kPicksAtOnce + gl_LocalInvocationID.x;
  ivec4 points[kPicksAtOnce];
  uint ids[kPicksAtOnce];
  bool exist[kPicksAtOnce];
  for (uint k = 0u; k < kPicksAtOnce; ++k)
    exist[k] = fetch_point(first + k * gl_WorkGroupSize.x, points[k], ids[k]);
  for (uint k = 0u; k < kPicksAtOnce; ++k) draw(exist[k], points[k], ids[k]);
#else
  draw(invocation_index());
#endif
}
