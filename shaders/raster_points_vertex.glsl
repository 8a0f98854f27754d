// The GL_POINTS rasterizer: a vertex a point, pulled from the same sources as everywhere.
#include "projection.glsl"
#include "point_source.glsl"

invariant gl_Position;
layout(location = 0) flat out ivec4 vertex_point;
layout(location = 1) flat out uint vertex_id;

void main() {
  // Outside of every clip volume, for what is no point or not beyond the near plane
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = view.point_size;
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
  if (clip.w > view.near) gl_Position = clip;
}
