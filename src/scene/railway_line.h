// The course of the railway in the "corridor" scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace stipple::scene {

constexpr double kLineLength = 100'000.0;  // metres of easting from end to end
constexpr double kSpan = 60.0;             // between masts, along the line

// A place on the line and what lies ahead and to the left there.
struct LinePlace {
  glm::dvec3 centre;  // between the tracks, at the foot of the ballast
  glm::dvec2 ahead;   // of length 1
  glm::dvec2 left;
};

// The line, exactly, at `easting` metres from its western end: bends of 3 km radius and more, gradients of 1.2 % and
// less.
LinePlace line_at(double easting);

// The same from a table of spans, to within 5 mm and several times faster.
class RailwayLine {
 public:
  RailwayLine();

  std::uint32_t spans() const { return static_cast<std::uint32_t>(ends_.size() - 1); }
  // `along` is 0 to kSpan metres ahead of the beginning of `span`.
  LinePlace at(std::uint32_t span, double along) const;

 private:
  std::vector<LinePlace> ends_;  // of the spans: the first at 0, the last at or just past kLineLength
};

}  // namespace stipple::scene
