// Holds the frames of one run against the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "octree/cloud/grid.h"
#include "render/measure/error_parts.h"
#include "render/measure/image.h"
#include "src/study/curve.h"
#include "src/study/truth.h"

namespace stipple {

// Takes the frames of a run in their order; truths must stay where they are until the next frame. All cores.
class FrameJudge {
 public:
  struct Options {
    PointSize point_size;
    bool flip_every_frame = false;  // or only at QualityMarks, and where asked for
    bool carries = true;            // the method takes something along from frame to frame
  };
  FrameJudge(const Grid& grid, const Options& options) : grid_(grid), options_(options) {}

  // A frame that is not to be judged, but from which points may come along.
  void pass(const FrameData& frame);
  CurvePoint judge(const FrameState& state, const FrameData& frame, const Image& image, const View& view,
                   const Truth& truth);

 private:
  // The frame before, as far as the next needs it.
  struct Before {
    ShownPoints points;
    std::optional<Image> image;  // where it was judged
    const Truth* truth = nullptr;
  };

  void remember(const FrameData& frame);
  double reuse(const FrameData& frame) const;

  Grid grid_;
  Options options_;
  QualityMarks marks_;
  ShownPoints shown_;  // by any frame
  bool first_ = true;
  Before before_;
};

}  // namespace stipple
