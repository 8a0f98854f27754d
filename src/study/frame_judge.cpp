#include "src/study/frame_judge.h"

#include "render/measure/flicker.h"
#include "render/measure/flip.h"
#include "render/measure/psnr.h"
#include "render/measure/ssim.h"

namespace stipple {

void FrameJudge::remember(const FrameData& frame) {
  shown_.add(frame.ids);
  before_.points.clear();
  before_.points.add(frame.ids);
  first_ = false;
}

void FrameJudge::pass(const FrameData& frame) {
  remember(frame);
  before_.image.reset();
  before_.truth = nullptr;
}

double FrameJudge::reuse(const FrameData& frame) const {
  std::size_t covered = 0;
  std::size_t again = 0;
  for (const std::uint32_t id : frame.ids) {
    if (id == kNoPoint) continue;
    ++covered;
    again += before_.points.contains(id) ? 1u : 0u;
  }
  return covered ? static_cast<double>(again) / static_cast<double>(covered) : 0.0;
}

CurvePoint FrameJudge::judge(const FrameState& state, const FrameData& frame, const Image& image, const View& view,
                             const Truth& truth) {
  CurvePoint point{.state = state,
                   .mse = mean_squared_error(image, truth.reference),
                   .covered_mse = covered_mean_squared_error(image, truth.reference, truth.frame.ids),
                   .ssim = ssim(image, truth.reference),
                   .flip = {},
                   .rates = frame_rates(frame, truth.frame, view, grid_, options_.point_size),
                   .identical = frame.ids == truth.brute_force_ids,
                   .parts = error_parts(image, frame.ids, truth.reference, truth.brute_force_ids, shown_),
                   .reuse = {},
                   .flicker = {}};
  if (marks_.passes(psnr_db(point.mse)) || options_.flip_every_frame) point.flip = flip(image, truth.reference);
  if (options_.carries && !first_) point.reuse = reuse(frame);
  if (before_.truth)
    point.flicker = flicker({*before_.image, before_.truth->reference, before_.truth->frame.ids},
                            {image, truth.reference, truth.frame.ids})
                        .mean;
  remember(frame);
  before_.image = image;
  before_.truth = &truth;
  return point;
}

}  // namespace stipple
