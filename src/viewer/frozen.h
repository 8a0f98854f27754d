// The points of a finished picture, and nothing else, to be looked at from elsewhere.
#pragma once

#include "render/frame/vertex_carry.h"
#include "render/method/method.h"

namespace stipple {

class Frozen final : public Method {
 public:
  // Keeps a copy of the points that `frame` shows. Throws Error as VertexCarry does.
  explicit Frozen(const FeedbackTarget& frame) : points_(frame.size()) { points_.prepare(frame); }

  Carry carry() const override { return Carry::none; }
  void start_view(const View&) override { drawn_ = false; }
  Selection select(std::uint32_t) override {
    drawn_ = true;
    return {.items = {points_.vertices()}};
  }
  bool finished() const override { return drawn_; }
  std::optional<std::vector<ColoredPoints>> colored() const override {
    const CarriedVertices vertices = points_.vertices();
    return std::vector<ColoredPoints>{{vertices.points, vertices.ids}};
  }

 private:
  VertexCarry points_;
  bool drawn_ = false;  // for this view
};

}  // namespace stipple
