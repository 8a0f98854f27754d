// What is drawn: the open cloud, its methods, and the renderer that goes from one to the other.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "render/method/progressive_renderer.h"
#include "src/viewer/preview.h"
#include "src/viewer/workshop.h"

namespace stipple {

class Stage {
 public:
  Stage(Workshop& workshop, RasterizerKind rasterizer, double point_size);

  // The last picture stays until there is a new one. `again`: the same points, in other colours say.
  void open(const Opening& opening, bool again = false);
  // As soon as it is ready.
  void want(Mode mode);
  void set_point_size(double pixels);

  // What the workshop has finished.
  void take(const finished::Beginning& beginning);
  void take(const finished::Preview& preview);
  void take(const finished::Cloud& cloud);
  void take(finished::MadeMethod made);
  void take(const finished::Failure& failure);

  // The next frame of the view, if there is anything to draw.
  void draw(const View& view, std::uint32_t budget);
  // Null before the first.
  const FeedbackTarget* frame() const { return renderer_ ? renderer_->frame() : nullptr; }

  bool empty() const { return !renderer_; }
  // Nothing more would be drawn for this view before something is delivered.
  bool at_rest(const View& view) const { return !renderer_ || (view == drawn_view_ && report_.converged); }
  // At rest, and it is what was asked for.
  bool complete(const View& view) const { return shown_mode_ && shown_mode_ == wanted_ && at_rest(view); }

  Mode wanted() const { return wanted_; }
  std::optional<Mode> shown() const { return shown_mode_; }        // none: nothing, or a preview
  std::uint64_t filled() const { return report_.points_filled; }   // by the last frame
  std::uint64_t filled_for_view() const { return view_points_; }   // by all frames of this view
  std::uint64_t frames() const { return frames_; }                 // drawn ever
  const Dataset* dataset() const { return dataset_.get(); }        // null: none is open
  const std::optional<SourceInfo>& info() const { return info_; }  // of what is open, or being read
  Grid grid() const { return grid_; }                              // of what frame() shows
  const std::string& error() const { return error_; }
  void dismiss_error() { error_.clear(); }

 private:
  struct Ready {
    std::shared_ptr<Method> method;
    std::shared_ptr<const Dataset> dataset;  // that it draws from
  };
  void show(Ready next, std::optional<Mode> mode, const Grid& grid, const ColorMap& colors);
  bool make_renderer();

  Workshop& workshop_;
  RasterizerKind rasterizer_;
  double point_size_;

  std::shared_ptr<const Dataset> dataset_;
  std::optional<SourceInfo> info_;
  std::map<Mode, Ready> ready_;  // of the open cloud
  std::set<Mode> asked_;         // of the workshop, and not come yet
  std::shared_ptr<Preview> preview_;
  bool again_ = false;
  bool new_points_ = true;  // what is shown has other points, or colours, than what comes
  Mode wanted_ = Mode::hybrid;
  std::string error_;

  // What is shown; data before what draws from them
  Ready shown_;
  std::optional<Mode> shown_mode_;
  Grid grid_;
  ColorMap colors_;
  std::unique_ptr<ProgressiveRenderer> renderer_;
  View drawn_view_;
  FrameReport report_;
  std::uint64_t view_points_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace stipple
