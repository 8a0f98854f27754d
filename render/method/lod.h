// Level of detail without feedback: the viewer that T16 compares with (its section 4, there T15), and Potree (Schuetz
// 2016).
#pragma once

#include <memory>
#include <vector>

#include "render/method/lod_source.h"
#include "render/method/method.h"

namespace stipple {

// Every frame is drawn from nothing: the nodes in sight whose points are farthest apart on the screen, as many as the
// budget has points for. There it stops: what a larger budget would draw is never seen, and the picture is the
// brute-force picture only where the budget holds all that is in sight.
class Lod final : public Method {
 public:
  explicit Lod(std::unique_ptr<LodSource> source) : source_(std::move(source)) {}

  Carry carry() const override { return Carry::none; }
  void set_point_size(const PointSize& point_size) override {
    with_splats_ = point_size.world > 0.0;
    source_->set_point_size(point_size);
  }
  void start_view(const View& view) override;
  Selection select(std::uint32_t budget) override;
  bool finished() const override { return finished_; }
  SelectionCounts counts() const override;
  Unread unread() const override { return source_->unread(); }
  std::optional<std::vector<ColoredPoints>> colored() const override { return source_->colored(); }

 private:
  void sort();
  // How many of parts_ a frame draws.
  std::size_t chosen(std::uint32_t budget) const;

  std::unique_ptr<LodSource> source_;
  std::vector<LodSource::Part> parts_;  // in sight, the most urgent first
  bool finished_ = false;
  bool with_splats_ = false;
};

}  // namespace stipple
