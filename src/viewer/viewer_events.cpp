// What is done in the window: events, and what the cursor is at.
#include "src/viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace stipple {
namespace {

MouseButton button_of(int code) {
  return code == GLFW_MOUSE_BUTTON_RIGHT    ? MouseButton::right
         : code == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::middle
                                            : MouseButton::left;
}

}  // namespace

void Viewer::take_event(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  frames_to_show_ = kFramesAfterEvent;
  switch (event.kind) {
    case Kind::press:
      if (!gui_.takes_mouse()) press(event);
      break;
    case Kind::release:
      drags_divider_ = false;
      if (const auto gesture = pointer_.release(button_of(event.code), event.place, event.seconds)) follow(*gesture);
      break;
    case Kind::move:
      cursor_ = event.place;
      hover_stale_ = true;
      if (drags_divider_) divider_ = std::clamp(event.place.x / size_.x, 0.02, 0.98);
      if (const auto gesture = pointer_.move(event.place)) follow(*gesture);
      break;
    case Kind::scroll:
      if (gui_.takes_mouse()) break;
      rig_.zoom(event.amount.y, place_of_eye(event.place, eye_at(event.place)), eye_size(),
                hovered_ ? std::optional(world_of(*hovered_)) : std::nullopt);
      break;
    case Kind::key:
    case Kind::character:
      if (gui_.takes_keys()) break;
      if (const auto command = command_of(event)) {
        right_meant_ = stage_.is_split() && (event.modifiers & GLFW_MOD_SHIFT) != 0;
        execute(*command);
        right_meant_ = false;
      }
      break;
    case Kind::drop:
      if (!event.paths.empty()) open(event.paths);
      break;
    case Kind::refresh:
      break;
  }
}

bool Viewer::shows_both() const {
  return stage_.is_split() && shown_sides_ == Shown::both && stage_.frame(Stage::left) && stage_.frame(Stage::right);
}

void Viewer::press(const InputEvent& event) {
  constexpr double kReach = 6.0;  // pixels to each side of the line
  if (shows_both() && std::abs(event.place.x - divider_column()) <= kReach * window_.text_scale()) {
    drags_divider_ = true;
    return;
  }
  pointer_.press(button_of(event.code),
                 {.shift = (event.modifiers & GLFW_MOD_SHIFT) != 0, .alt = (event.modifiers & GLFW_MOD_ALT) != 0},
                 event.place, event.seconds);
  pressed_eye_ = eye_at(event.place);
  grabbed_ = hovered_ ? std::optional(world_of(*hovered_)) : std::nullopt;
}

void Viewer::follow(const Gesture& gesture) {
  const glm::dvec2 from = place_of_eye(gesture.from, pressed_eye_);
  const glm::dvec2 to = place_of_eye(gesture.to, pressed_eye_);
  switch (gesture.kind) {
    case Gesture::Kind::orbit:
      rig_.orbit(from, to, eye_size());
      break;
    case Gesture::Kind::pan:
      rig_.pan(from, to, eye_size(), grabbed_);
      break;
    case Gesture::Kind::turn:
      rig_.turn(from, to, eye_size());
      break;
    case Gesture::Kind::click:
    case Gesture::Kind::double_click:
      if (!stage_.frame()) break;
      clicked_for_pivot_ = gesture.kind == Gesture::Kind::double_click;
      ask(clicked_, gesture.from);
      break;
  }
}

void Viewer::fly() {
  glm::dvec3 direction{0.0};
  if (!gui_.takes_keys() && !window_.is_down(GLFW_KEY_LEFT_CONTROL) && !window_.is_down(GLFW_KEY_RIGHT_CONTROL)) {
    const auto axis = [&](int more, int less) { return double(window_.is_down(more)) - double(window_.is_down(less)); };
    direction = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
  }
  const double now = window_.seconds();
  if (direction == glm::dvec3(0.0) || stage_.empty()) {
    flown_until_ = -1.0;
    return;
  }
  // A step that took long (a method being shown first, say) must not end behind the cloud
  if (flown_until_ >= 0.0) rig_.fly(direction, std::min(now - flown_until_, 0.1));
  flown_until_ = now;
  if (stage_.frame() && !ahead_.waiting()) ahead_.ask(*stage_.frame(), stage_.frame()->size() / 2);
}

void Viewer::face(double yaw_deg, double pitch_deg) {
  rig_.face(glm::radians(yaw_deg), glm::radians(pitch_deg), static_cast<double>(eye_size().x) / eye_size().y);
}

void Viewer::go_home() {
  if (!home_) return;
  const double aspect = static_cast<double>(eye_size().x) / eye_size().y;
  const Pose pose = pose_of(*home_);
  rig_.face(pose.yaw, pose.pitch, aspect);
  if (std::abs(aspect - home_aspect_) < 0.01 * aspect) rig_.place(*home_);
}

// --- What the cursor is at

glm::ivec2 Viewer::eye_size(const glm::ivec2& size) const {
  return {two_eyes_ ? std::max(size.x / 2, 1) : size.x, size.y};
}

std::size_t Viewer::eye_at(const glm::dvec2& place) const {
  return two_eyes_ && place.x >= eye_size().x ? 1 : 0;
}

glm::dvec2 Viewer::place_of_eye(const glm::dvec2& place, std::size_t eye) const {
  return {place.x - static_cast<double>(eye) * eye_size().x, place.y};
}

void Viewer::ask(PixelReader& reader, const glm::dvec2& place) const {
  const std::size_t eye = eye_at(place);
  const FeedbackTarget* const frame = stage_.frame(Stage::left, eye);
  if (!frame) return;
  reader.ask(*frame, glm::ivec2(place_of_eye(place, eye) * glm::dvec2(frame->size()) / glm::dvec2(eye_size())));
}

glm::dvec3 Viewer::world_of(const PickedPixel& pixel) const {
  return stage_.grid().world_from_grid(pixel.position);
}

std::array<std::string, 3> Viewer::place_of(const PickedPixel& pixel) const {
  return {exact_text(stage_.grid(), pixel.position, 0), exact_text(stage_.grid(), pixel.position, 1),
          exact_text(stage_.grid(), pixel.position, 2)};
}

void Viewer::read_answers() {
  std::optional<PickedPixel> answer;
  if (hover_.answered(answer)) {
    hovered_ = answer;
    under_cursor_ = answer ? std::optional(place_of(*answer)) : std::nullopt;
    frames_to_show_ = std::max(frames_to_show_, 1);
  }
  if (ahead_.answered(answer) && answer) rig_.set_ahead(world_of(*answer));
  if (!clicked_.answered(answer) || !answer) return;
  frames_to_show_ = kFramesAfterEvent;
  if (clicked_for_pivot_) {
    rig_.set_pivot(world_of(*answer));
    note_ = "turning around this point now";
  } else {
    pick(*answer);
  }
}

void Viewer::ask_under_cursor() {
  if (!hover_stale_ || hover_.waiting() || !stage_.frame() || pointer_.holds()) return;
  hover_stale_ = false;
  ask(hover_, cursor_);
}

void Viewer::pick(const PickedPixel& pixel) {
  if (picks_.size() == 2) picks_.clear();
  picks_.push_back({pixel, world_of(pixel), place_of(pixel), {}});
  workshop_.describe(pixel.id, pixel.position);
}

}  // namespace stipple
