#include "src/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "octree/core/error.h"
#include "octree/store/open_tree.h"
#include "src/cli/cli.h"

namespace stipple {
namespace {

constexpr double kWorkInterval = 0.1;  // seconds between two looks at what is being loaded

// How far apart points are that lie evenly on the ground of the box, or on its largest side, to two digits.
double spacing_of(const WorldBox& box, std::uint64_t points) {
  const glm::dvec3 e = box.max - box.min;
  const double area = std::max({e.x * e.y, e.x * e.z, e.y * e.z});
  if (!(area > 0.0) || points == 0) return 1.0;
  const double spacing = std::sqrt(area / static_cast<double>(points));
  const double digit = std::pow(10.0, std::floor(std::log10(spacing)) - 1.0);
  return digit * std::round(spacing / digit);
}

}  // namespace

Viewer::Viewer(Window& window, ViewerOptions options)
    : window_(window),
      options_(std::move(options)),
      gui_(window),
      workshop_(window),
      stage_(workshop_, options_.rasterizer, options_.point_size),
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
  return stage_.at_rest(wanted_view()) && workshop_.status().phase == WorkStatus::Phase::idle && flown_until_ < 0.0 &&
         !hover_.waiting() && !clicked_.waiting() && !compares_soon() && !comparison_.busy() && frames_to_show_ == 0;
}

bool Viewer::step(double most_seconds) {
  const bool drawing = !stage_.at_rest(wanted_view()) || frames_to_show_ > 0 || flown_until_ >= 0.0 ||
                       hover_.waiting() || clicked_.waiting();
  const bool working = workshop_.status().phase != WorkStatus::Phase::idle || tree_job_.running();
  const bool hidden = window_.hidden();
  window_.wait_events(drawing && !hidden                     ? 0.0
                      : working || hidden || compares_soon() ? std::min(kWorkInterval, most_seconds)
                                                             : most_seconds);
  take_finished();
  for (const InputEvent& event : window_.take_events()) take_event(event);
  if (working) frames_to_show_ = std::max(frames_to_show_, 1);
  take_tree();
  if (comparison_.take()) frames_to_show_ = kFramesAfterEvent;
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
  comparison_.end();
  can_build_ = inputs.size() != 1 || !is_tree(inputs.front());
  window_.set_title(fmt::format("{} - stipple", std::filesystem::path(inputs.front()).filename().string()));
  stage_.open({.inputs = inputs,
               .color = options_.color,
               .mode = options_.mode.value_or(Mode::hybrid),
               .method = options_.method,
               .aspect = static_cast<double>(size_.x) / size_.y});
}

void Viewer::color_by(const ColorChoice& color) {
  options_.color = color;
  if (stage_.can_recolor()) return stage_.recolor(color);
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
  spacing_ = spacing_of(cloud.box, cloud.dataset->info.point_count);
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

void Viewer::take(const finished::Colors&) {
  if (!workshop_.will_recolor()) choose_shown_colors();
}

void Viewer::choose_shown_colors() {
  const ColorMap& colors = stage_.dataset()->colors;
  options_.color = ColorChoice(colors.attribute, colors.ramp, colors.hidden);
}

void Viewer::take(const finished::Failure& failure) {
  if (options_.exit_after_screenshot && !screenshot_.empty() && !failure.cancelled) throw Error(failure.message);
  if (failure.recoloring) choose_shown_colors();
  if (failure.cancelled)
    note_ = "cancelled";
  else
    warn(failure.message);
}

void Viewer::take_tree() {
  const auto result = tree_job_.take();
  if (!result) return;
  frames_to_show_ = kFramesAfterEvent;
  built_tree_ = result->failure.empty() ? result->folder : "";
  note_ = result->cancelled         ? "cancelled"
          : result->failure.empty() ? fmt::format("{} is built", result->folder)
                                    : result->failure;
}

void Viewer::take(const finished::Description& description) {
  for (Pick& pick : picks_)
    if (pick.pixel.id == description.id) pick.values = description.values;
}

}  // namespace stipple
