// What is shown beside the picture, and what is asked for there.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/frame/eye_dome.h"
#include "src/run/view_run.h"
#include "src/viewer/comparison.h"
#include "src/viewer/describe_point.h"
#include "src/viewer/keys.h"
#include "src/viewer/pixel_reader.h"
#include "src/viewer/stage.h"
#include "src/viewer/tree_job.h"

namespace stipple {

// A point of the cloud that was clicked at.
struct Pick {
  PickedPixel pixel;
  glm::dvec3 world;
  std::array<std::string, 3> place;  // exact
  PointValues values;                // empty until they have been read
};

// What the panel shows.
struct PanelFacts {
  const Stage& stage;
  const WorkStatus& work;
  std::span<const Pick> picks;
  View view;
  double frames_per_second = 0.0;
  std::span<const float> frame_ms;  // of the latest frames, the oldest first
  BudgetPolicy policy;
  ColorChoice color;
  PointSize point_size;
  double spacing = 1.0;  // of the points, about, world units
  std::uint32_t background = 0;
  bool shaded = false;
  EyeDomeOptions eye_dome;
  bool two_eyes = false;
  std::optional<int> divider;  // column of the picture, where two sides are seen
  bool right_alone = false;    // of two sides
  const ReferenceComparison& comparison;
  std::optional<std::array<std::size_t, 4>> box_counts;  // by SightedBox::State, where boxes are shown
  const std::optional<std::array<std::string, 3>>& under_cursor;
  std::span<const std::vector<std::string>> recent;  // inputs opened before
  const TreeJob& tree_job;
  const std::string& built_tree;  // the last one; empty: none
  bool can_build = false;         // there are files open that are no tree
  const std::string& note;        // what happened last
  bool panel_shown = true;
  bool keys_shown = false;
  float scale = 1.0f;
};

// What was asked for in it.
struct PanelWishes {
  std::vector<Command> commands;
  std::optional<std::pair<Mode, Stage::Side>> mode;
  std::optional<ColorChoice> color;
  std::optional<PointSize> point_size;
  std::optional<std::uint32_t> background;
  std::optional<EyeDomeOptions> eye_dome;
  std::optional<BudgetPolicy> policy;
  std::optional<glm::ivec2> picture;  // of this size
  std::optional<std::vector<std::string>> open;
  bool dismiss_error = false;
};

// Between Gui::begin_frame() and end_frame().
PanelWishes show_panel(const PanelFacts& facts);

// Which attributes the cloud can be coloured by, the usual ones first.
std::vector<std::string> colors_of(const SourceInfo& info);

}  // namespace stipple
