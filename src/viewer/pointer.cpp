#include "src/viewer/pointer.h"

namespace stipple {
namespace {

// Longer than this, and it was a drag that did not move.
constexpr double kClickSeconds = 0.5;
// From one click to the next, as most desktops have it.
constexpr double kDoubleClickSeconds = 0.4;

}  // namespace

void Pointer::press(MouseButton button, const Modifiers& modifiers, const glm::dvec2& place, double seconds) {
  if (held_) return;
  held_ = button;
  dragging_ = false;
  pressed_at_ = place;
  last_ = place;
  pressed_seconds_ = seconds;
  if (button == MouseButton::right || (button == MouseButton::left && modifiers.shift))
    drag_ = Gesture::Kind::pan;
  else if (button == MouseButton::middle || modifiers.alt)
    drag_ = Gesture::Kind::turn;
  else
    drag_ = Gesture::Kind::orbit;
}

std::optional<Gesture> Pointer::move(const glm::dvec2& place) {
  if (!held_) return std::nullopt;
  if (!dragging_ && glm::distance(place, pressed_at_) <= slack_) return std::nullopt;
  dragging_ = true;
  const glm::dvec2 from = last_;
  last_ = place;
  return Gesture{drag_, from, place};
}

std::optional<Gesture> Pointer::release(MouseButton button, const glm::dvec2& place, double seconds) {
  if (held_ != button) return std::nullopt;
  held_.reset();
  if (button != MouseButton::left || dragging_ || seconds - pressed_seconds_ > kClickSeconds) {
    clicked_seconds_.reset();
    return std::nullopt;
  }
  if (clicked_seconds_ && seconds - *clicked_seconds_ <= kDoubleClickSeconds &&
      glm::distance(place, clicked_at_) <= slack_) {
    clicked_seconds_.reset();
    return Gesture{Gesture::Kind::double_click, pressed_at_, place};
  }
  clicked_seconds_ = seconds;
  clicked_at_ = place;
  return Gesture{Gesture::Kind::click, pressed_at_, place};
}

}  // namespace stipple
