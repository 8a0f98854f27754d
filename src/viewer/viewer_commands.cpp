// What the keys do.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "octree/build/stream/options.h"
#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "src/camera/camera_file.h"
#include "src/run/free_memory.h"
#include "src/viewer/legend.h"
#include "src/viewer/viewer.h"

namespace stipple {
namespace {

// screenshot.png, screenshot-2.png, ...: the first that is not there.
std::string free_name(const std::string& stem, const std::string& extension) {
  std::string name = stem + extension;
  for (int number = 2; std::filesystem::exists(name); ++number) name = fmt::format("{}-{}{}", stem, number, extension);
  return name;
}

}  // namespace

void Viewer::execute(Command command) {
  frames_to_show_ = kFramesAfterEvent;
  note_.clear();
  const auto want = [this](Mode mode) { stage_.want(mode, right_meant_ ? Stage::right : Stage::left); };
  switch (command) {
    case Command::method_unstructured:
      return want(Mode::unstructured);
    case Command::method_hierarchical:
      return want(Mode::hierarchical);
    case Command::method_hybrid:
      return want(Mode::hybrid);
    case Command::method_brute_force:
      return want(Mode::brute_force);
    case Command::method_lod:
      return want(Mode::lod);
    case Command::method_subsample:
      return want(Mode::subsample);
    case Command::split:
      shown_sides_ = Shown::both;
      two_eyes_ = false;
      return stage_.split(!stage_.is_split());
    case Command::blink:
      return blink();
    case Command::two_eyes:
      return look_with_two_eyes();
    case Command::compare:
      return compare();
    case Command::again:
      comparison_.begin_view(window_.seconds());
      return stage_.begin_again();
    case Command::freeze:
      return freeze();
    case Command::boxes:
      boxes_shown_ = !boxes_shown_;
      return;
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
      return set_point_size({options_.point_size.pixels + 1.0, options_.point_size.world});
    case Command::smaller_points:
      return set_point_size({options_.point_size.pixels - 1.0, options_.point_size.world});
    case Command::larger_splats:
      return larger_splats();
    case Command::smaller_splats:
      return smaller_splats();
    case Command::hide_class:
      return hide_class();
    case Command::shade:
      options_.shaded = !options_.shaded;
      return;
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
      return want_screenshot(std::nullopt);
    case Command::build_tree:
      return build_tree_of_inputs();
    case Command::copy_command:
      return copy_command();
    case Command::cancel:
      if (keys_shown_)
        keys_shown_ = false;
      else if (workshop_.status().phase != WorkStatus::Phase::idle)
        workshop_.cancel();
      else
        tree_job_.cancel();
      return;
    case Command::quit:
      quit_ = true;
      return;
  }
}

void Viewer::blink() {
  shown_sides_ = shown_sides_ == Shown::both ? Shown::left : shown_sides_ == Shown::left ? Shown::right : Shown::both;
}

void Viewer::look_with_two_eyes() {
  two_eyes_ = !two_eyes_;
  if (two_eyes_) stage_.split(false);
}

void Viewer::compare() {
  comparison_.turn();
  if (comparison_.on() && two_eyes_) note_ = "the reference is that of one eye: Y shows its picture";
  const Dataset* dataset = stage_.dataset();
  if (comparison_.on() && dataset && !dataset->in_memory())
    note_ = "the reference needs all points in memory: F1 reads them";
}

void Viewer::freeze() {
  stage_.freeze(!stage_.frozen());
  if (!stage_.frozen()) return;
  frozen_view_ = view();
  frozen_reach_ = glm::distance(rig_.camera().eye, rig_.pivot());
  note_ = "these points stay; F goes on drawing";
}

void Viewer::next_color() {
  const Dataset* dataset = stage_.dataset();
  if (!dataset) return;
  const std::vector<std::string> names = colors_of(dataset->info);
  ColorChoice choice = options_.color;
  if (choice.attribute.empty()) choice.attribute = dataset->colors.attribute;
  const auto now = std::ranges::find(names, choice.attribute);
  const std::size_t next = now == names.end() ? 0 : static_cast<std::size_t>(now - names.begin()) + 1;
  choice.attribute = names[next % names.size()];
  color_by(choice);
}

void Viewer::want_screenshot(const std::optional<glm::ivec2>& size) {
  screenshot_ = free_name("screenshot", ".png");
  options_.screenshot_size = size;
  note_ = size ? fmt::format("drawing a picture of {} x {} pixels", size->x, size->y) : "screenshot follows";
}

void Viewer::build_tree_of_inputs() {
  if (tree_job_.running()) {
    note_ = "an octree is being built already; Esc ends that";
  } else if (!can_build_) {
    note_ = "there is no file open to build an octree of";
  } else {
    // Half of what is free: the window has its points there, too
    const std::uint64_t memory = std::clamp(free_memory() / 2, kLeastMemory, StreamOptions{}.memory);
    const std::filesystem::path first(options_.inputs.front());
    const std::filesystem::path bare = first.has_filename() ? first : first.parent_path();
    tree_job_.start(options_.inputs, free_name((bare.parent_path() / bare.stem()).string(), ".octree"), memory);
  }
}

void Viewer::hide_class() {
  ColorChoice choice = options_.color;
  if (picks_.empty()) {
    if (choice.hidden.none()) {
      note_ = "pick a point first: points of its class are hidden then";
      return;
    }
    choice.hidden.reset();
  } else {
    const PointValues& values = picks_.back().values;
    const auto value = std::ranges::find(values, kClassAttribute, &PointValues::value_type::first);
    if (value == values.end()) {
      note_ = values.empty() ? "its attributes are being read" : "the points have no class";
      return;
    }
    const double number = std::stod(value->second);
    if (!(number >= 0.0 && number < static_cast<double>(choice.hidden.size()))) {
      note_ = fmt::format("{} is no LAS class", value->second);
      return;
    }
    choice.hidden.set(static_cast<std::size_t>(number));
    note_ = fmt::format("class {} {} is hidden", value->second, class_name(static_cast<int>(number)));
    picks_.clear();
  }
  color_by(choice);
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

void Viewer::set_point_size(const PointSize& wanted) {
  stage_.set_point_size({std::clamp(wanted.pixels, 1.0, 10.0), std::max(wanted.world, 0.0)});
  options_.point_size = stage_.pane().point_size();
}

// The first are as large as the points are apart.
void Viewer::larger_splats() {
  const PointSize& now = options_.point_size;
  set_point_size({now.pixels, now.world > 0.0 ? 2.0 * now.world : spacing_});
}

void Viewer::smaller_splats() {
  const PointSize& now = options_.point_size;
  set_point_size({now.pixels, now.world > spacing_ ? 0.5 * now.world : 0.0});
}

}  // namespace stipple
