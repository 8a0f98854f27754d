// The colour spaces of FLIP.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace stipple {

// Linear RGB, 0 to 1, of an sRGB byte (IEC 61966-2-1).
inline std::array<float, 256> linear_of_srgb_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double s = static_cast<double>(i) / 255.0;
    table[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return table;
}

// CIE XYZ relative to the white (so that white is 1, 1, 1) from linear RGB with the primaries of ITU-R BT.709 and white
// D65 (x = 0.3127, y = 0.3290). Columns: what red, green and blue contribute.
inline glm::mat3 relative_xyz_from_rgb() {
  const glm::dmat3 xyz({0.4123907993, 0.2126390059, 0.0193308187}, {0.3575843394, 0.7151686788, 0.1191947798},
                       {0.1804807884, 0.0721923154, 0.9505321522});
  const glm::dvec3 white = xyz * glm::dvec3(1.0);
  return {xyz[0] / white, xyz[1] / white, xyz[2] / white};
}

// The cube root of a number from 0 to about 1, to float precision. Unlike std::cbrt, compilers can do many at once.
inline float cube_root(float t) {
  // A third of the exponent, then Newton's steps: the guess is within 4 % (Kahan), and each step squares the error
  float root = std::bit_cast<float>(std::bit_cast<std::uint32_t>(t) / 3u + 709921077u);
  for (int step = 0; step < 3; ++step) root = (2.0f * root + t / (root * root)) * (1.0f / 3.0f);
  return root;
}

// CIE 1976 L*a*b* of relative XYZ.
inline glm::vec3 lab_of(const glm::vec3& xyz) {
  constexpr float kDelta = 6.0f / 29.0f;
  const auto f = [](float t) {
    const float linear = t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
    const float root = cube_root(t);
    return t > kDelta * kDelta * kDelta ? root : linear;
  };
  const float x = f(xyz.x);
  const float y = f(xyz.y);
  const float z = f(xyz.z);
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

// Colours look more colourful where there is more light (FLIP, section 4.1.2: the Hunt effect).
inline glm::vec3 hunt_adjusted(const glm::vec3& lab) {
  const float scale = 0.01f * lab.x;
  return {lab.x, scale * lab.y, scale * lab.z};
}

// Distance for large differences of colour: lightness as in a city's blocks, chroma as the crow flies.
inline float hyab(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = a - b;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

}  // namespace stipple
