// Where a picture is taken from.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace stipple {

// World coordinates in the cloud's own units. Throughout, image row 0 is the top one.
struct Camera {
  glm::dvec3 eye{0.0};
  glm::dvec3 target{0.0, 1.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  double fov_deg = 60.0;  // vertical field of view, above 0 and below 180
};

// A camera and the pixels it is drawn to, resolved into an orthonormal basis.
// For a world point p and r = p - eye: depth = dot(forward, r); the point is drawn where depth > near; its place in
// pixels is x = width / 2 * (1 + dot(right, r) * cot_x / depth), y = height / 2 * (1 - dot(up, r) * cot_y / depth),
// and its pixel is (floor(x), floor(y)) where 0 <= x < width and 0 <= y < height.
//
// Two eyes look in the same direction, from places beside `eye`: lines of sight are parallel, so that depths, and with
// them the sizes of pixels and splats, are the same for both. Each has a picture of `size`.
struct View {
  glm::dvec3 eye{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};
  double cot_x = 1.0;       // cot_y / aspect
  double cot_y = 1.0;       // cot(fov / 2)
  double near = 1e-3;       // world units, above 0. Far is infinite
  glm::ivec2 size{0};       // pixels
  double eyes_apart = 0.0;  // world units; 0: there is one eye

  bool operator==(const View&) const = default;

  std::size_t eyes() const { return eyes_apart > 0.0 ? 2 : 1; }
  // The view of one of them alone, the left one first.
  View of_eye(std::size_t eye) const;

  // World size of a pixel at this depth.
  double pixel_size(double depth) const { return 2.0 * depth / (cot_y * size.y); }
};

// How far apart two eyes are where nothing is said, as a share of the distance to what they look at: the rule of thumb
// of stereo photographers.
inline constexpr double kUsualEyesApart = 1.0 / 30.0;

// Throws UsageError when eye and target coincide, the field of view is out of range, or size is not positive. An `up`
// parallel to the line of sight is replaced by the axis farthest from it.
View make_view(const Camera& camera, const glm::ivec2& size, double near);

}  // namespace stipple
