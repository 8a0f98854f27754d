#include "src/scene/railway_line.h"

#include <cmath>

#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

// One of the waves that the course is made of.
struct Wave {
  double amplitude;
  double length;
  double phase;  // turns
};

struct Value {
  double at;
  double slope;
};

Value sum_of_waves(const Wave (&waves)[3], double x) {
  Value sum{0, 0};
  for (const Wave& wave : waves) {
    const double turns = x / wave.length + wave.phase;
    sum.at += wave.amplitude * sin_turns(turns);
    sum.slope += wave.amplitude * 6.283185307179586 / wave.length * cos_turns(turns);
  }
  return sum;
}

Value northing(double x) {
  return sum_of_waves({{2600, 41000, 0.1}, {420, 11300, 0.4}, {110, 5100, 0.7}}, x);
}

}  // namespace

LinePlace line_at(double easting) {
  const Value north = northing(easting);
  const Value height = sum_of_waves({{55, 52000, 0.2}, {11, 14000, 0.0}, {2.2, 4700, 0.3}}, easting);
  const double length = std::sqrt(1 + north.slope * north.slope);
  const glm::dvec2 ahead = glm::dvec2(1, north.slope) / length;
  return {{easting, north.at, height.at}, ahead, {-ahead.y, ahead.x}};
}

RailwayLine::RailwayLine() {
  ends_.push_back(line_at(0.0));
  while (ends_.back().centre.x < kLineLength) {
    const double start = ends_.back().centre.x;
    // The slope at the middle of the span is that of its chord, to within centimetres
    const double slope = northing(start + 0.45 * kSpan).slope;
    ends_.push_back(line_at(start + kSpan / std::sqrt(1 + slope * slope)));
  }
}

LinePlace RailwayLine::at(std::uint32_t span, double along) const {
  const LinePlace& from = ends_[span];
  const LinePlace& to = ends_[span + 1];
  const double t = along / kSpan;
  // The chord, and the bend that the directions at both ends leave beside it
  const double chord = glm::length(glm::dvec2(to.centre - from.centre));
  const glm::dvec2 bend =
      chord * t * (1 - t) *
      ((1 - t) * from.ahead - t * to.ahead + (2 * t - 1) / chord * glm::dvec2(to.centre - from.centre));
  LinePlace place;
  place.centre = glm::mix(from.centre, to.centre, t) + glm::dvec3(bend, 0);
  place.ahead = glm::mix(from.ahead, to.ahead, t);
  place.left = {-place.ahead.y, place.ahead.x};
  return place;
}

}  // namespace stipple::scene
