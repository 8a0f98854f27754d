#include "src/viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "octree/store/open_tree.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"
#include "src/run/provenance.h"
#include "src/viewer/command_line.h"

namespace stipple {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kFirstBudget = 100'000;
constexpr std::size_t kFramesPlotted = 120;
// Panels need a frame to learn of an event and one to lay themselves out.
constexpr int kFramesAfterEvent = 3;
// A camera that has not moved for so long stands still.
constexpr double kStillSeconds = 0.15;
// Points a frame of a still view, at least: nobody waits for its next frame, all wait for its last.
constexpr std::uint32_t kLeastStillBudget = 200'000;
// With no more points a frame than that, pixels are what takes its time.
constexpr std::uint32_t kLeastMovingBudget = 20'000;
constexpr double kWorkInterval = 0.1;  // seconds between two looks at what is being loaded

MouseButton button_of(int code) {
  return code == GLFW_MOUSE_BUTTON_RIGHT    ? MouseButton::right
         : code == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::middle
                                            : MouseButton::left;
}

// screenshot.png, screenshot-2.png, ...: the first that is not there.
std::string free_name(const std::string& stem, const std::string& extension) {
  std::string name = stem + extension;
  for (int number = 2; std::filesystem::exists(name); ++number) name = fmt::format("{}-{}{}", stem, number, extension);
  return name;
}

}  // namespace

Viewer::Viewer(Window& window, ViewerOptions options)
    : window_(window),
      options_(std::move(options)),
      gui_(window),
      workshop_(window),
      stage_(workshop_, options_.rasterizer, PointSize(options_.point_size, options_.splat_size)),
      pointer_(4.0 * window.text_scale()),
      screenshot_(options_.screenshot) {
  size_ = glm::max(window_.size(), 1);
  set_policy(options_.policy);
  if (options_.path) flight_.set_path(*options_.path);
  if (!options_.inputs.empty()) open(options_.inputs);
}

void Viewer::run() {
  while (step()) {
  }
  // What the workshop cannot be stopped in need not be watched
  window_.hide();
}

bool Viewer::at_rest() const {
  return stage_.at_rest(view()) && workshop_.status().phase == WorkStatus::Phase::idle && flown_until_ < 0.0 &&
         !hover_.waiting() && !clicked_.waiting() && frames_to_show_ == 0;
}

bool Viewer::step(double most_seconds) {
  const bool drawing =
      !stage_.at_rest(view()) || frames_to_show_ > 0 || flown_until_ >= 0.0 || hover_.waiting() || clicked_.waiting();
  const bool working = workshop_.status().phase != WorkStatus::Phase::idle;
  const bool hidden = window_.hidden();
  window_.wait_events(drawing && !hidden  ? 0.0
                      : working || hidden ? std::min(kWorkInterval, most_seconds)
                                          : most_seconds);
  take_finished();
  for (const InputEvent& event : window_.take_events()) take_event(event);
  if (working) frames_to_show_ = std::max(frames_to_show_, 1);
  fly();
  if (flight_.replays()) rig_.place(flight_.camera(window_.seconds()));
  flight_.see(rig_.camera(), window_.seconds());
  read_answers();
  if (!window_.hidden()) show_frame();
  return !quit_ && !window_.asked_to_close();
}

void Viewer::open(const std::vector<std::string>& inputs) {
  options_.inputs = inputs;
  entered_ = false;
  awaited_ = false;
  picks_.clear();
  const bool tree = inputs.size() == 1 && is_tree(inputs.front());
  window_.set_title(fmt::format("{} - stipple", std::filesystem::path(inputs.front()).filename().string()));
  stage_.open({.inputs = inputs,
               .color = options_.color,
               .mode = options_.mode.value_or(tree ? Mode::hierarchical : Mode::hybrid),
               .method = options_.method,
               .aspect = static_cast<double>(size_.x) / size_.y});
}

void Viewer::reopen(const std::string& color) {
  options_.color = color;
  stage_.open({.inputs = options_.inputs,
               .color = color,
               .mode = stage_.wanted(),
               .method = options_.method,
               .aspect = static_cast<double>(size_.x) / size_.y},
              true);
}

void Viewer::take_finished() {
  for (Finished& next : workshop_.take()) {
    frames_to_show_ = kFramesAfterEvent;
    hover_stale_ = true;
    std::visit(
        [this](auto& one) {
          using T = std::decay_t<decltype(one)>;
          if constexpr (!std::is_same_v<T, finished::Description>) stage_.take(std::move(one));
          if constexpr (requires { take(one); }) take(one);
        },
        next);
  }
}

void Viewer::take(const finished::Beginning& beginning) {
  const WorldBox& box = beginning.info.stated_bounds;
  if (entered_ || box.empty()) return;
  const double aspect = static_cast<double>(size_.x) / size_.y;
  const Pose pose = facing(box, glm::radians(55.0), glm::radians(-30.0), 60.0, aspect);
  rig_.enter(box, options_.camera.value_or(camera_of(pose, glm::distance(box.min, box.max))),
             near_plane(beginning.info.grid));
  awaited_ = true;
}

void Viewer::take(const finished::Cloud& cloud) {
  home_ = cloud.home;
  home_aspect_ = static_cast<double>(size_.x) / size_.y;
  for (const std::string& warning : cloud.dataset->info.warnings) note_ = warning;
  if (std::exchange(entered_, true)) return;
  remember(options_.recent, options_.inputs);
  // Who has begun to look around is not moved
  const bool stays = awaited_ && rig_.moved();
  const Camera camera = stays ? rig_.camera() : options_.camera.value_or(cloud.home);
  rig_.enter(cloud.box, camera, near_plane(cloud.dataset->points.grid));
  options_.camera.reset();
  awaited_ = false;
}

void Viewer::take(const finished::Failure& failure) {
  if (options_.exit_after_screenshot && !screenshot_.empty() && !failure.cancelled) throw Error(failure.message);
  if (failure.cancelled)
    note_ = "cancelled";
  else
    warn(failure.message);
}

void Viewer::take(const finished::Description& description) {
  for (Pick& pick : picks_)
    if (pick.pixel.id == description.id) pick.values = description.values;
}

// --- Events

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
      rig_.zoom(event.amount.y, event.place, size_, hovered_ ? std::optional(world_of(*hovered_)) : std::nullopt);
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
  grabbed_ = hovered_ ? std::optional(world_of(*hovered_)) : std::nullopt;
}

void Viewer::follow(const Gesture& gesture) {
  switch (gesture.kind) {
    case Gesture::Kind::orbit:
      rig_.orbit(gesture.from, gesture.to, size_);
      break;
    case Gesture::Kind::pan:
      rig_.pan(gesture.from, gesture.to, size_, grabbed_);
      break;
    case Gesture::Kind::turn:
      rig_.turn(gesture.from, gesture.to, size_);
      break;
    case Gesture::Kind::click:
    case Gesture::Kind::double_click:
      if (!stage_.frame()) break;
      clicked_for_pivot_ = gesture.kind == Gesture::Kind::double_click;
      clicked_.ask(*stage_.frame(), frame_pixel(gesture.from));
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
  rig_.face(glm::radians(yaw_deg), glm::radians(pitch_deg), static_cast<double>(size_.x) / size_.y);
}

void Viewer::go_home() {
  if (!home_) return;
  const double aspect = static_cast<double>(size_.x) / size_.y;
  const Pose pose = pose_of(*home_);
  rig_.face(pose.yaw, pose.pitch, aspect);
  if (std::abs(aspect - home_aspect_) < 0.01 * aspect) rig_.place(*home_);
}

void Viewer::execute(Command command) {
  frames_to_show_ = kFramesAfterEvent;
  note_.clear();
  switch (command) {
    case Command::method_unstructured:
      return stage_.want(Mode::unstructured, right_meant_ ? Stage::right : Stage::left);
    case Command::method_hierarchical:
      return stage_.want(Mode::hierarchical, right_meant_ ? Stage::right : Stage::left);
    case Command::method_hybrid:
      return stage_.want(Mode::hybrid, right_meant_ ? Stage::right : Stage::left);
    case Command::method_brute_force:
      return stage_.want(Mode::brute_force, right_meant_ ? Stage::right : Stage::left);
    case Command::method_lod:
      return stage_.want(Mode::lod, right_meant_ ? Stage::right : Stage::left);
    case Command::method_subsample:
      return stage_.want(Mode::subsample, right_meant_ ? Stage::right : Stage::left);
    case Command::split:
      shown_sides_ = Shown::both;
      return stage_.split(!stage_.is_split());
    case Command::blink:
      return blink();
    case Command::home:
      return go_home();
    case Command::view_top:
      return face(90.0, -90.0);
    case Command::view_bottom:
      return face(90.0, 90.0);
    case Command::view_front:
      return face(90.0, 0.0);
    case Command::view_back:
      return face(-90.0, 0.0);
    case Command::view_left:
      return face(0.0, 0.0);
    case Command::view_right:
      return face(180.0, 0.0);
    case Command::next_color:
      return next_color();
    case Command::larger_points:
      return set_point_size(options_.point_size + 1.0);
    case Command::smaller_points:
      return set_point_size(options_.point_size - 1.0);
    case Command::clear_picks:
      return picks_.clear();
    case Command::panel:
      options_.panel_shown = !options_.panel_shown;
      return;
    case Command::keys:
      keys_shown_ = !keys_shown_;
      return;
    case Command::record:
      return record();
    case Command::replay:
      return replay();
    case Command::screenshot:
      screenshot_ = free_name("screenshot", ".png");
      note_ = "screenshot follows";
      return;
    case Command::copy_command:
      return copy_command();
    case Command::cancel:
      if (keys_shown_)
        keys_shown_ = false;
      else
        workshop_.cancel();
      return;
    case Command::quit:
      quit_ = true;
      return;
  }
}

void Viewer::blink() {
  shown_sides_ = shown_sides_ == Shown::both ? Shown::left : shown_sides_ == Shown::left ? Shown::right : Shown::both;
}

void Viewer::next_color() {
  const Dataset* dataset = stage_.dataset();
  if (!dataset) return;
  const std::vector<std::string> names = colors_of(dataset->info);
  const auto now = std::ranges::find(names, options_.color.empty() ? dataset->colors.attribute : options_.color);
  const std::size_t next = now == names.end() ? 0 : static_cast<std::size_t>(now - names.begin()) + 1;
  reopen(names[next % names.size()]);
}

void Viewer::record() {
  if (!flight_.records()) {
    flight_.record(window_.seconds());
    note_ = "recording; R ends it";
    return;
  }
  if (!flight_.finish()) {
    note_ = "nothing moved: no path was written";
    return;
  }
  const std::string name = free_name("path", ".json");
  try {
    const Json document{{"paths", Json::array({json_of(*flight_.path())})}};
    write_file(name, document.dump(2) + "\n");
    note_ = fmt::format("{} written", name);
  } catch (const Error& e) {
    note_ = e.what();
  }
}

void Viewer::replay() {
  if (flight_.replays())
    flight_.stop();
  else if (flight_.records())
    note_ = "R ends recording first";
  else if (flight_.path())
    flight_.replay(window_.seconds());
  else
    note_ = "there is no path: R records one";
}

void Viewer::set_point_size(double pixels) {
  options_.point_size = std::clamp(pixels, 1.0, 10.0);
  stage_.set_point_size(options_.point_size);
}

// --- What the cursor is at

glm::ivec2 Viewer::frame_pixel(const glm::dvec2& place) const {
  return glm::ivec2(place * glm::dvec2(stage_.frame()->size()) / glm::dvec2(size_));
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
  hover_.ask(*stage_.frame(), frame_pixel(cursor_));
}

void Viewer::pick(const PickedPixel& pixel) {
  if (picks_.size() == 2) picks_.clear();
  picks_.push_back({pixel, world_of(pixel), place_of(pixel), {}});
  workshop_.describe(pixel.id, pixel.position);
}

// --- Frames

void Viewer::notice_motion() {
  const Camera& now = rig_.camera();
  if (now.eye == last_camera_.eye && now.target == last_camera_.target && now.up == last_camera_.up) return;
  last_camera_ = now;
  moved_at_ = window_.seconds();
}

bool Viewer::moving() const {
  return moved_at_ >= 0.0 && window_.seconds() - moved_at_ < kStillSeconds;
}

std::uint32_t Viewer::budget() const {
  if (!controller_) return options_.policy.points;
  return moving() ? controller_->budget() : std::max(controller_->budget(), kLeastStillBudget);
}

void Viewer::set_policy(const BudgetPolicy& policy) {
  options_.policy = policy;
  const std::uint32_t first = controller_ ? controller_->budget() : kFirstBudget;
  controller_.reset();
  if (policy.frames_per_second)
    controller_.emplace(1000.0 / *policy.frames_per_second, first, BudgetController::Limits{});
}

void Viewer::draw_cloud() {
  const View fine = view();
  const bool coarse = moving() && controller_ && resolution_.divisor() > 1;
  const View next = coarse ? rig_.view(glm::max(size_ / resolution_.divisor(), 1)) : fine;
  if (stage_.at_rest(next)) return;
  stage_.draw(next, budget());
  hover_stale_ = true;
  if (stage_.at_rest(fine)) frames_to_show_ = kFramesAfterEvent;
}

void Viewer::show_frame() {
  size_ = glm::max(window_.size(), 1);
  notice_motion();
  if (stage_.at_rest(view()) && frames_to_show_ == 0) return;
  const auto start = Clock::now();
  const std::uint64_t frames_before = stage_.frames();
  const bool was_moving = moving();
  draw_cloud();
  if (stage_.frame())
    display_.show(scene(), size_);
  else
    display_.clear(options_.background, size_);
  show_panels();
  glFinish();
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (stage_.frames() > frames_before) learn_from(ms, was_moving);
  ask_under_cursor();
  // The last frame of panels that are settled
  if (frames_to_show_ <= 1) take_screenshot_if_due();
  window_.swap();
  ++frames_shown_;
  frames_to_show_ = std::max(frames_to_show_ - 1, 0);

  const double now = window_.seconds();
  const double between = now - std::exchange(last_frame_, now);
  // After a pause the rate begins anew
  frame_seconds_ = between > 0.5 || frame_seconds_ == 0.0 ? 1e-3 * ms : 0.8 * frame_seconds_ + 0.2 * between;
}

void Viewer::learn_from(double ms, bool was_moving) {
  if (frame_ms_.size() == kFramesPlotted) frame_ms_.erase(frame_ms_.begin());
  frame_ms_.push_back(static_cast<float>(ms));
  if (!controller_ || stage_.pane().mode() == Mode::brute_force) return;
  const bool least = controller_->budget() <= kLeastMovingBudget;
  controller_->frame_done(stage_.filled(), ms);
  if (was_moving) resolution_.frame_done(ms, least, 1000.0 / *options_.policy.frames_per_second);
}

void Viewer::show_panels() {
  gui_.begin_frame();
  const WorkStatus work = workshop_.status();
  const PanelWishes wishes = show_panel({.stage = stage_,
                                         .work = work,
                                         .picks = picks_,
                                         .view = view(),
                                         .frames_per_second = frame_seconds_ > 0.0 ? 1.0 / frame_seconds_ : 0.0,
                                         .frame_ms = frame_ms_,
                                         .budget = budget(),
                                         .policy = options_.policy,
                                         .point_size = options_.point_size,
                                         .background = options_.background,
                                         .divider = shows_both() ? std::optional(divider_column()) : std::nullopt,
                                         .right_alone = shown_sides_ == Shown::right,
                                         .under_cursor = under_cursor_,
                                         .recent = options_.recent,
                                         .note = note_,
                                         .panel_shown = options_.panel_shown,
                                         .keys_shown = keys_shown_,
                                         .scale = window_.text_scale()});
  gui_.end_frame();
  grant(wishes);
}

void Viewer::grant(const PanelWishes& wishes) {
  for (const Command command : wishes.commands) execute(command);
  if (wishes.mode) stage_.want(wishes.mode->first, wishes.mode->second);
  if (wishes.color) reopen(*wishes.color);
  if (wishes.point_size) set_point_size(*wishes.point_size);
  if (wishes.background) options_.background = *wishes.background;
  if (wishes.policy) set_policy(*wishes.policy);
  if (wishes.open) open(*wishes.open);
  if (wishes.dismiss_error) stage_.dismiss_error();
}

// --- What leaves the window

ViewerSettings Viewer::settings() const {
  return {.background = options_.background,
          .point_size = options_.point_size,
          .frames_per_second = options_.policy.frames_per_second.value_or(ViewerSettings{}.frames_per_second),
          .panel_shown = options_.panel_shown};
}

Display::Scene Viewer::scene() const {
  Display::Scene scene{.left = stage_.frame(), .background = options_.background};
  if (shows_both()) {
    scene.right = stage_.frame(Stage::right);
    scene.divider = divider_column();
  } else if (stage_.is_split() && shown_sides_ == Shown::right && stage_.frame(Stage::right)) {
    scene.left = stage_.frame(Stage::right);
  }
  return scene;
}

Image Viewer::picture() {
  if (stage_.frame()) return display_.picture(scene());
  throw Error("there is nothing to picture yet");
}

Image Viewer::window_picture() const {
  Image image{size_, {}};
  const auto row = 3 * static_cast<std::size_t>(size_.x);
  image.rgb.resize(row * static_cast<std::size_t>(size_.y));
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // Rows count from the lower edge
  for (int y = 0; y < size_.y; ++y)
    glReadPixels(0, y, size_.x, 1, GL_RGB, GL_UNSIGNED_BYTE,
                 &image.rgb[row * static_cast<std::size_t>(size_.y - 1 - y)]);
  return image;
}

void Viewer::take_screenshot_if_due() {
  if (screenshot_.empty() || !stage_.complete(view()) || workshop_.status().phase != WorkStatus::Phase::idle) return;
  const std::string path = std::exchange(screenshot_, {});
  frames_to_show_ = kFramesAfterEvent;
  try {
    write_screenshot(path);
    note_ = fmt::format("{} written", path);
  } catch (const Error& e) {
    if (options_.exit_after_screenshot) throw;
    note_ = e.what();
  }
  if (options_.exit_after_screenshot) quit_ = true;
}

void Viewer::write_screenshot(const std::string& path) {
  Json facts{{"mode", name_of(*stage_.pane().mode())},
             {"raster", name_of(options_.rasterizer)},
             {"point_size", options_.point_size},
             {"splat_size", options_.splat_size},
             {"background", fmt::format("{:06x}", options_.background)},
             {"gl_renderer", window_.renderer()},
             {"gl_version", window_.version()}};
  facts.update(dataset_provenance(*stage_.dataset()));
  facts["view"] = view_provenance(view());
  facts.update(program_provenance());
  write_png(path, options_.with_panels ? window_picture() : picture(), {{"stipple", text_of(facts)}});
}

void Viewer::copy_command() {
  const Dataset* dataset = stage_.dataset();
  if (!dataset || !stage_.pane().mode()) return;
  window_.set_clipboard(text_of(RenderCommand{.inputs = options_.inputs,
                                              .mode = std::string(name_of(*stage_.pane().mode())),
                                              .raster = std::string(name_of(options_.rasterizer)),
                                              .camera = rig_.camera(),
                                              .size = size_,
                                              .color = dataset->colors.attribute,
                                              .point_size = options_.point_size,
                                              .splat_size = options_.splat_size,
                                              .background = options_.background}));
  note_ = "the command that renders this view is in the clipboard";
}

}  // namespace stipple
