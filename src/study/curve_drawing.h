// One method on its way along one route: the timed part of a study.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "src/study/curve.h"
#include "src/study/frame_judge.h"
#include "src/study/frame_keeper.h"
#include "src/study/progress.h"
#include "src/study/route.h"
#include "src/study/study.h"
#include "src/study/truth.h"

namespace stipple {

class CurveDrawing {
 public:
  // All must outlive it. Uploads what the mode keeps on the GPU and has every pass run once, outside the clock.
  CurveDrawing(const StudySettings& settings, const Dataset& dataset, Mode mode, const StudyProgress& progress);

  // Frames go to `keeper`, where there is one. Once.
  std::vector<CurvePoint> run(Regime regime, const Route& route, std::span<const Truth> truths, FrameKeeper* keeper);

 private:
  void observe(const FrameState& state, const View& view, const Truth& truth);
  void pass();

  const StudySettings& settings_;
  const StudyProgress& progress_;
  std::unique_ptr<Method> method_;
  ProgressiveRenderer renderer_;
  TimedDrawing drawing_;
  Grid grid_;
  std::optional<FrameJudge> judge_;
  FrameKeeper* keeper_ = nullptr;
  std::vector<CurvePoint> points_;
  Image image_;  // of the last frame observed
};

}  // namespace stipple
