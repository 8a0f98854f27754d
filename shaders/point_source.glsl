// Where the points of a pass come from:
//   SOURCE_RANGE    consecutive points of a buffer (fill)
//   SOURCE_VERTICES points collected from the last frame, counted on the GPU (reproject as S19)
//   SOURCE_INDICES  places of points collected from the last frame, counted on the GPU (reproject as S18)
//   SOURCE_STEERED  consecutive points of a buffer, around its end, that the GPU chose itself (fill as S19 steers it)
//   SOURCE_PICKS    points of a buffer in the places that another names (fill by cluster)
//   SOURCE_GRID     the last frame itself, a point a pixel (reproject as T16)
// A PointIndex names one of them: a number, or a pixel, because dividing numbers costs more than all the rest.
#include "packing.glsl"

#ifdef SOURCE_GRID

layout(binding = 0) uniform isampler2D previous_points;
layout(binding = 1) uniform usampler2D previous_ids;

#define PointIndex ivec2

bool fetch_point(ivec2 pixel, out ivec4 point, out uint id) {
  if (any(greaterThanEqual(pixel, textureSize(previous_ids, 0)))) return false;
  id = texelFetch(previous_ids, pixel, 0).x;
  if (id == kNoPoint) return false;
  point = texelFetch(previous_points, pixel, 0);
  return true;
}

#else

#define PointIndex uint

layout(binding = 4) uniform isamplerBuffer source_points;
layout(binding = 5) uniform usamplerBuffer source_ids;
layout(location = 0) uniform uint source_first;
layout(location = 2) uniform uint source_id_shift;  // id minus place, modulo 2^32
layout(location = 3) uniform bool source_has_ids;

#ifdef SOURCE_VERTICES
layout(std430, binding = 2) readonly buffer SourceCommand { IndirectCommand source_command; };
uint source_count() { return source_command.count; }
#elif defined(SOURCE_INDICES) || defined(SOURCE_STEERED)
layout(std430, binding = 4) readonly buffer SourceCommands { IndirectCommand source_commands[]; };
uint source_count() { return source_commands[source_first].count; }
#endif
#if !defined(SOURCE_VERTICES) && !defined(SOURCE_INDICES)
layout(location = 1) uniform uint source_size;
#endif
#if defined(SOURCE_RANGE) || defined(SOURCE_PICKS)
uint source_count() { return source_size; }
#endif

#if defined(SOURCE_PICKS) || defined(SOURCE_INDICES)
layout(binding = 6) uniform usamplerBuffer source_places;
uint fetch_place(uint i) { return texelFetch(source_places, int(i)).x; }
#endif
#if defined(SOURCE_PICKS)
uint place_of(uint i) { return fetch_place(source_first + i); }
#elif defined(SOURCE_INDICES)
uint place_of(uint i) { return fetch_place(source_commands[source_first].begin + i); }
#elif defined(SOURCE_STEERED)
uint place_of(uint i) {
  uint place = source_commands[source_first].begin + i;
  return place < source_size ? place : place - source_size;
}
#else
uint place_of(uint i) { return source_first + i; }
#endif

bool fetch_point(uint i, out ivec4 point, out uint id) {
  if (i >= source_count()) return false;
  uint place = place_of(i);
  point = texelFetch(source_points, int(place));
  // The uppermost bit of an opaque colour; a point of none is not to be seen
  if (point.w >= 0) return false;
  id = source_has_ids ? texelFetch(source_ids, int(place)).x : source_id_shift + place;
  return true;
}

#endif
