// PASS_NEAREST draws with depth test, as the papers do: among points of one depth the first drawn stays.
// PASS_CLAIM and PASS_REPEAT see the points at exactly that depth again and give the pixel to the lowest id.
#ifdef SPLATS
#include "projection.glsl"
#endif
#include "packing.glsl"

layout(location = 0) flat in ivec4 vertex_point;
layout(location = 1) flat in uint vertex_id;
#ifdef SPLATS
layout(location = 2) flat in vec3 vertex_splat;
bool covered() { return vertex_splat.z == 0.0 || in_splat(vertex_splat.xy, vertex_splat.z, ivec2(gl_FragCoord.xy)); }
#else
bool covered() { return true; }
#endif

#ifdef PASS_NEAREST

layout(location = 0) out ivec4 target_point;
layout(location = 1) out uint target_id;

void main() {
  if (!covered()) discard;
  target_point = vertex_point;
  target_id = vertex_id;
}

#else

// Without it the stores below happen before the depth test
layout(early_fragment_tests) in;
layout(r32ui, binding = 1) uniform uimage2D target_ids;
layout(rgba32i, binding = 2) uniform writeonly iimage2D target_points;
#include "ties.glsl"

void main() {
  if (!covered()) return;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef PASS_CLAIM
  // The first drawn is in place already, so whoever is lower is a tie
  if (vertex_id >= imageLoad(target_ids, pixel).x) return;
  if (imageAtomicMin(target_ids, pixel, vertex_id) <= vertex_id) return;
  imageStore(target_points, pixel, vertex_point);
  note_tie(vertex_point, vertex_id, pixel);
#else
  if (imageLoad(target_ids, pixel).x == vertex_id) imageStore(target_points, pixel, vertex_point);
#endif
}

#endif
