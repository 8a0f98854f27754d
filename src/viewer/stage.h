// What is drawn: the open cloud and its methods, one at a time or two side by side.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "src/viewer/pane.h"
#include "src/viewer/preview.h"
#include "src/viewer/workshop.h"

namespace stipple {

class Stage {
 public:
  enum Side { left = 0, right = 1 };

  Stage(Workshop& workshop, RasterizerKind rasterizer, const PointSize& point_size);

  // The last picture stays until there is a new one. `again`: the same points, in other colours say.
  void open(const Opening& opening, bool again = false);
  // The points that are there get these colours: only what these come from is read, and nothing but them goes to the
  // GPU.
  void recolor(const ColorChoice& color);
  // Whether that is so of what is open: all its points are in memory. Else it is to be opened again.
  bool can_recolor() const;
  // As soon as it is ready. Where the other side has it, the sides change places.
  void want(Mode mode, Side side = left);
  // Whether the right side is drawn.
  void split(bool on);
  // Where the rasterizer draws no such points, they stay as they are and there is an error.
  void set_point_size(const PointSize& point_size);
  // The pictures begin anew, from nothing.
  void begin_again();

  // The points of the pictures stay, whatever the view, until there is something else to show or this is undone.
  void freeze(bool on);
  bool frozen() const { return panes_[left].frozen(); }

  // What the workshop has finished.
  void take(const finished::Beginning& beginning);
  void take(const finished::Preview& preview);
  void take(const finished::Cloud& cloud);
  void take(const finished::Colors& colors);
  void take(finished::MadeMethod made);
  void take(const finished::Failure& failure);

  // The next frame of the view, if there is anything to draw; of two sides both. Returns the points drawn, as
  // draw_more() does.
  std::uint64_t draw(const View& view, std::uint32_t budget);
  // Whether that frame can be added to, on one side at least.
  bool adds_to_frames() const;
  std::uint64_t draw_more(std::uint32_t budget);

  bool is_split() const { return split_; }
  const Pane& pane(Side side = left) const { return panes_[side]; }
  Mode wanted(Side side = left) const { return wanted_[side]; }
  // Null before the first, and where the last view had fewer eyes.
  const FeedbackTarget* frame(Side side = left, std::size_t eye = 0) const { return panes_[side].frame(eye); }
  bool empty() const { return panes_[left].empty(); }
  // Nothing more would be drawn for this view before something is delivered.
  bool at_rest(const View& view) const;
  // At rest, and it is what was asked for.
  bool complete(const View& view) const;
  std::uint64_t filled() const;  // by the last frame
  std::uint64_t frames() const;  // drawn ever

  Unread unread() const;  // what the pictures lack, of both sides

  const Dataset* dataset() const { return dataset_.get(); }        // null: none is open
  const std::optional<SourceInfo>& info() const { return info_; }  // of what is open, or being read
  Grid grid() const { return panes_[left].content().grid; }        // of what frame() shows
  // Sent to the GPU by the last change of colours.
  std::uint64_t color_bytes() const { return color_bytes_; }
  const std::string& error() const { return error_; }
  void dismiss_error() { error_.clear(); }

 private:
  std::size_t sides() const { return split_ ? 2 : 1; }
  // Of each side.
  std::uint32_t share_of(std::uint32_t budget) const;
  void show(Side side, const Pane::Content& content);

  Workshop& workshop_;
  std::shared_ptr<const Dataset> dataset_;
  std::optional<SourceInfo> info_;
  std::map<Mode, Pane::Content> ready_;  // of the open cloud
  std::set<Mode> asked_;                 // of the workshop, and not come yet
  std::shared_ptr<Preview> preview_;
  bool again_ = false;
  bool opened_ = false;  // the dataset is of what was opened last
  std::uint64_t color_bytes_ = 0;
  std::string error_;
  bool split_ = false;
  std::array<Mode, 2> wanted_{Mode::hybrid, Mode::unstructured};
  std::array<bool, 2> outdated_{true, true};  // shows other points, or colours, than the open cloud's
  std::array<Pane, 2> panes_;
};

}  // namespace stipple
