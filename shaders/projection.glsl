// The one place where a point becomes a pixel and a depth. Every pass of every method includes it, and everything is
// `precise`, so that a point lands on the same pixel with the same depth whoever draws it.

// Positions are int32 on the cloud's grid. The eye is a grid cell plus a residual; cells are split into half and odd
// bit because the difference of two int32 takes 33 bits: 2 * (p/2 - c/2) + (p%2 - c%2) is exact wherever it matters.
layout(std140, binding = 0) uniform ViewBlock {
  ivec4 eye_half;    // cell >> 1
  ivec4 eye_odd;     // cell & 1
  vec4 grid_scale;   // world units a cell, per axis
  vec4 eye_residual; // world units from the cell to the eye
  vec4 right;        // unit vector times cot(fov_x / 2)
  vec4 down;         // minus up times cot(fov_y / 2): row 0 is the top one
  vec4 forward;      // unit vector
  ivec2 size;        // pixels
  float near;        // world units
  float point_size;  // pixels: edge of a far point's square
  float splat_at_near;  // pixels: diameter of a splat on the near plane; 0: there are no splats
  float largest_splat;  // pixels
  float snapping;       // pixels by which the rasterizer may move a point
} view;

vec3 world_from_eye(ivec3 p) {
  precise vec3 cells = vec3((p >> 1) - view.eye_half.xyz) * 2.0 + vec3((p & 1) - view.eye_odd.xyz);
  precise vec3 world = cells * view.grid_scale.xyz - view.eye_residual.xyz;
  return world;
}

// Clip coordinates: reversed depth with infinite far plane, so that z / w = near / distance.
vec4 clip_from_grid(ivec3 p) {
  precise vec3 r = world_from_eye(p);
  precise float x = dot(view.right.xyz, r);
  precise float y = dot(view.down.xyz, r);
  precise float w = dot(view.forward.xyz, r);
  return vec4(x, y, view.near, w);
}

// Place in pixels (x, y) and reversed depth (z). False where the centre is outside the picture or not beyond the near
// plane.
bool project(ivec3 p, out vec3 place) {
  precise vec4 clip = clip_from_grid(p);
  if (!(clip.w > view.near)) return false;
  precise vec2 ndc = clip.xy / clip.w;
  precise vec2 pixels = (ndc * 0.5 + 0.5) * vec2(view.size);
  precise float depth = clip.z / clip.w;
  place = vec3(pixels, depth);
  return all(greaterThanEqual(pixels, vec2(0.0))) && all(lessThan(pixels, vec2(view.size)));
}

// The diameter in pixels of the round splat that a point at this (reversed) depth is drawn as, or 0 where it is far: a square
// of view.point_size. Depends on the depth alone, so that a point has the same size whoever draws it.
float splat_diameter(float depth) {
  precise float diameter = depth * view.splat_at_near;
  return diameter > view.point_size ? min(diameter, view.largest_splat) : 0.0;
}

// A splat covers the pixels whose centre lies in its disc, and that into which its own centre falls.
bool in_splat(vec2 place, float diameter, ivec2 pixel) {
  precise vec2 offset = vec2(pixel) + 0.5 - place;
  precise float squared = 4.0 * dot(offset, offset);
  return squared <= diameter * diameter || pixel == ivec2(floor(place));
}
