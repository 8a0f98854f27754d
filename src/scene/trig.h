// Sine and cosine from additions and multiplications only: the same bits on every machine, where libm differs.
#pragma once

#include <glm/glm.hpp>

#include "src/scene/floor.h"

namespace stipple::scene {

// Sine of an angle in turns (1 = 360 degrees); absolute error below 1e-11.
inline double sin_turns(double turns) {
  // Fold into a quarter turn either side of zero, where the Taylor series of degree 15 suffices
  double t = turns - static_cast<double>(floor_of(turns + 0.5));
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = t * 6.283185307179586;
  const double y = x * x;
  return x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156 * (1 - y / 210)))))));
}

inline double cos_turns(double turns) {
  return sin_turns(turns + 0.25);
}

// (cosine, sine)
inline glm::dvec2 direction_from_turns(double turns) {
  return {cos_turns(turns), sin_turns(turns)};
}

}  // namespace stipple::scene
