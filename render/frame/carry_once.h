// Points that cover several pixels are carried once, not pixel by pixel.
#pragma once

#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"

namespace stipple {

class CarryOnce {
 public:
  CarryOnce();

  // Makes the carried ids of a finished frame: each point that it shows keeps one pixel, a few where its place in a
  // table by hashes is taken by another.
  void choose(FeedbackTarget& frame);

 private:
  Program mark_;
  Program choose_;
  GpuBuffer firsts_;
};

}  // namespace stipple
