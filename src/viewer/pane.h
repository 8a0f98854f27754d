// One picture that fills up: a method, and the renderer that goes on when the method is another.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/method/progressive_renderer.h"
#include "render/store/dataset.h"
#include "src/viewer/frozen.h"

namespace stipple {

class Pane {
 public:
  // What can be drawn.
  struct Content {
    std::shared_ptr<Method> method;
    std::shared_ptr<const Dataset> dataset;  // that the method draws from; null: it has its points itself
    std::optional<Mode> mode;                // none: a preview
    Grid grid;
    ColorMap colors;
  };

  Pane(RasterizerKind rasterizer, const PointSize& point_size) : rasterizer_(rasterizer), point_size_(point_size) {}

  // From now on draws this, beginning with the picture that is there unless the points are others or their colours.
  // Throws Error as ProgressiveRenderer does; then it shows what it showed.
  void show(Content next, bool other_points);
  // Its method's points have these colours now, which are those of `dataset`, and the picture gets them, too. Where
  // other classes are hidden, the view is drawn again, beginning with the picture.
  void recolor(const ColorUpload& colors, std::shared_ptr<const Dataset> dataset);
  // Throws Error where the rasterizer draws no such points; then they stay as they were.
  void set_point_size(const PointSize& point_size);
  const PointSize& point_size() const { return point_size_; }
  // From nothing.
  void begin_again() { set_point_size(PointSize(point_size_)); }
  // Keeps the points of the last frame, if there is one: from now on views show them and no others.
  void freeze();
  // Goes on drawing where it was.
  void thaw();
  bool frozen() const { return frozen_.has_value(); }
  // Of what is drawn from, those that the view sees, or saw when the pane was frozen. May wait for the GPU.
  std::vector<SightedBox> boxes() const;
  // Draws again though it was at rest: the method has got more points.
  void wake() { report_.converged = false; }

  // The next frame, if there is anything to draw. Returns the points drawn, as draw_more() does.
  std::uint64_t draw(const View& view, std::uint32_t budget);
  // Whether that frame can be added to.
  bool adds_to_frames() const { return renderer_ && !frozen_ && renderer_->adds_to_frames(); }
  std::uint64_t draw_more(std::uint32_t budget);
  // Nothing more would be drawn for this view.
  bool at_rest(const View& view) const { return !renderer_ || (view == drawn_view_ && report_.converged); }

  // What the picture lacks.
  Unread unread() const { return content_.method && !frozen_ ? content_.method->unread() : Unread{}; }

  // Null before the first, and where the last view had fewer eyes.
  const FeedbackTarget* frame(std::size_t eye = 0) const;
  bool empty() const { return !renderer_; }
  const Content& content() const { return content_; }
  std::optional<Mode> mode() const { return content_.mode; }
  std::uint64_t filled() const { return report_.points_filled; }  // by the last frame
  std::uint64_t filled_for_view() const { return view_points_; }  // by all frames of this view
  std::uint64_t frames() const { return frames_; }                // drawn ever

 private:
  struct Still {
    std::unique_ptr<Frozen> points;
    std::vector<SightedBox> boxes;
    std::unique_ptr<ProgressiveRenderer> renderer;  // of the points
  };

  std::unique_ptr<ProgressiveRenderer> make_renderer(Method& method, const Grid& grid,
                                                     const PointSize& point_size) const;

  RasterizerKind rasterizer_;
  PointSize point_size_;
  Content content_;
  std::unique_ptr<ProgressiveRenderer> renderer_;  // after the content it draws from
  std::optional<Still> frozen_;
  View drawn_view_;
  FrameReport report_;
  std::uint64_t view_points_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace stipple
