// What the mouse means: drags, clicks, double clicks. Pure: places and time come in as arguments.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace stipple {

enum class MouseButton { left, right, middle };

struct Gesture {
  enum class Kind {
    orbit,         // left drag
    pan,           // right drag, or left with shift
    turn,          // middle drag, or left with alt
    click,         // left, without moving
    double_click,  // the second of two clicks; the first was a click of its own
  };
  Kind kind;
  glm::dvec2 from;  // pixels; of drags the cursor's last place, of clicks where the button went down
  glm::dvec2 to;
};

class Pointer {
 public:
  struct Modifiers {
    bool shift = false;
    bool alt = false;
  };

  // `slack`: pixels by which the cursor may move within a click.
  explicit Pointer(double slack = 4.0) : slack_(slack) {}

  // A button went down in the picture (not in a panel).
  void press(MouseButton button, const Modifiers& modifiers, const glm::dvec2& place, double seconds);
  std::optional<Gesture> move(const glm::dvec2& place);
  std::optional<Gesture> release(MouseButton button, const glm::dvec2& place, double seconds);

  // A button that went down in the picture is still down.
  bool holds() const { return held_.has_value(); }
  // Where it went down.
  glm::dvec2 held_at() const { return pressed_at_; }

 private:
  double slack_;
  std::optional<MouseButton> held_;
  Gesture::Kind drag_ = Gesture::Kind::orbit;
  bool dragging_ = false;
  glm::dvec2 pressed_at_{0.0};
  glm::dvec2 last_{0.0};
  double pressed_seconds_ = 0.0;
  std::optional<double> clicked_seconds_;  // of the last click that may become a double click
  glm::dvec2 clicked_at_{0.0};
};

}  // namespace stipple
