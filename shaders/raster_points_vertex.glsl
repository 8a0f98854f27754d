// The GL_POINTS rasterizer: a vertex a point, pulled from the same sources as everywhere. SPLATS: points may be no single
// pixels; splats are the discs that fragments leave of larger squares.
#include "projection.glsl"
#include "point_source.glsl"

invariant gl_Position;
layout(location = 0) flat out ivec4 vertex_point;
layout(location = 1) flat out uint vertex_id;
#ifdef SPLATS
layout(location = 2) flat out vec3 vertex_splat;  // place in pixels, diameter
#endif

void main() {
  // Outside of every clip volume, for what is no point or not beyond the near plane
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = view.point_size;
#ifdef SPLATS
  vertex_splat = vec3(0.0);
#endif
#if !defined(SOURCE_GRID)
  PointIndex index = uint(gl_VertexID);
#elif defined(PASS_REPEAT)
  // Drawn indirectly as one instance; hardly ever drawn at all
  PointIndex index = ivec2(gl_VertexID % view.size.x, gl_VertexID / view.size.x);
#else
  PointIndex index = ivec2(gl_VertexID, gl_InstanceID);
#endif
  if (!fetch_point(index, vertex_point, vertex_id)) return;
  precise vec4 clip = clip_from_grid(vertex_point.xyz);
  if (!(clip.w > view.near)) return;
  gl_Position = clip;
#ifdef SPLATS
  vec3 place;
  project(vertex_point.xyz, place);
  vertex_splat = vec3(place.xy, splat_diameter(place.z));
  // A pixel more on each side than the disc has, for drivers that snap places to a raster of their own
  if (vertex_splat.z > 0.0) gl_PointSize = vertex_splat.z + 2.0;
#endif
}
