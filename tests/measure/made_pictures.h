// Pairs of pictures made by rule, for metrics whose values other programs have given.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "render/measure/image.h"

namespace stipple::test {

struct PicturePair {
  std::string name;
  Image test;
  Image reference;
};

// Thirty-two bits that depend on all of the argument.
inline std::uint32_t scrambled(std::uint32_t n) {
  n = (n ^ n >> 16) * 0x7FEB352Du;
  n = (n ^ n >> 15) * 0x846CA68Bu;
  return n ^ n >> 16;
}

// `color(x, y, c)` for channel c of each pixel, cut to 0 to 255.
template <class Color>
Image made(const glm::ivec2& size, const Color& color) {
  Image image{size, {}};
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (int c = 0; c < 3; ++c) image.rgb.push_back(static_cast<std::uint8_t>(std::clamp(color(x, y, c), 0, 255)));
  return image;
}

inline Image flat_picture(const glm::ivec2& size, int value) {
  return made(size, [value](int, int, int) { return value; });
}

// Squares of several colours under a slow ramp: edges, corners, flat places. Integers only, so that every machine makes
// the same.
inline int mosaic(int x, int y, int c) {
  const auto tile = static_cast<std::uint32_t>((x + 1000) / 9 * 4096 + (y + 1000) / 7);
  return static_cast<int>(scrambled(tile * 3 + static_cast<std::uint32_t>(c)) % 200) + (x * (c + 1) + 2 * y) / 8;
}

// One of 0 to n - 1 for a pixel and channel.
inline int dice(int x, int y, int c, int n) {
  return static_cast<int>(scrambled(static_cast<std::uint32_t>((y * 4096 + x) * 4 + c)) %
                          static_cast<std::uint32_t>(n));
}

inline std::vector<PicturePair> made_pairs() {
  const auto noisy = [](int x, int y, int c) { return mosaic(x, y, c) + dice(x, y, c, 41) - 20; };
  const auto with_holes = [](int x, int y, int c) { return dice(x, y, 3, 5) == 0 ? 128 : mosaic(x, y, c); };
  const auto shifted = [](int x, int y, int c) { return mosaic(x - 1, y, c); };
  const auto noise = [](int x, int y, int c) { return dice(x, y, c, 256); };
  const auto other_noise = [](int x, int y, int c) { return dice(x + 500, y, c, 256); };
  // A ramp against the same with a little more blue: colour alone, no edge
  const auto ramp = [](int x, int y, int) { return x + y; };
  const auto bluer = [](int x, int y, int c) { return x + y + (c == 2 ? 24 : 0); };
  return {{"noisy", made({96, 64}, noisy), made({96, 64}, mosaic)},
          {"holes", made({61, 47}, with_holes), made({61, 47}, mosaic)},
          {"shifted", made({80, 90}, shifted), made({80, 90}, mosaic)},
          {"noise", made({33, 29}, noise), made({33, 29}, other_noise)},
          {"bluer", made({120, 70}, bluer), made({120, 70}, ramp)},
          {"black and white", flat_picture({40, 40}, 0), flat_picture({40, 40}, 255)}};
}

}  // namespace stipple::test
