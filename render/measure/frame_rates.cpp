#include "render/measure/frame_rates.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "render/measure/percentile.h"
#include "render/measure/same_size.h"

namespace stipple {
namespace {

enum Verdict { kNothing, kRight, kHole, kGhost, kSeeThrough, kWrongPoint, kVerdicts };
using Verdicts = std::array<std::uint64_t, kVerdicts>;

class Judge {
 public:
  Judge(const FrameData& test, const FrameData& reference, const View& view, const Grid& grid,
        const PointSize& point_size, const RateTolerances& tolerances)
      : test_(test),
        reference_(reference),
        view_(view),
        grid_(grid),
        eye_(grid.grid_from_world(view.eye)),
        pixels_(point_size.pixels),
        splat_at_one_(point_size.splat_at_one(view)),
        place_(tolerances.place),
        depth_(tolerances.depth) {}

  Verdict verdict(int x, int y, std::size_t i) const {
    const std::uint32_t shown = test_.ids[i];
    const std::uint32_t expected = reference_.ids[i];
    if (shown == kNoPoint) return expected == kNoPoint ? kNothing : kHole;
    if (expected == kNoPoint || stale(x, y, i)) return kGhost;
    const double ratio = static_cast<double>(test_.depth[i]) / static_cast<double>(reference_.depth[i]);
    if (ratio < 1.0 - depth_) return kGhost;
    if (ratio > 1.0 + depth_) return kSeeThrough;
    return shown == expected ? kRight : kWrongPoint;
  }

 private:
  bool stale(int x, int y, std::size_t i) const {
    // See View for the projection
    const glm::dvec3 r = (glm::dvec3(test_.positions[i]) - eye_) * grid_.scale;
    const double depth = glm::dot(view_.forward, r);
    // The test's depth was made with floats: at the near plane itself the two may disagree
    if (!(depth > view_.near * (1.0 - depth_))) return true;
    if (!(std::abs(static_cast<double>(test_.depth[i]) - depth) <= depth_ * depth)) return true;
    const double place_x = 0.5 * view_.size.x * (1.0 + glm::dot(view_.right, r) * view_.cot_x / depth);
    const double place_y = 0.5 * view_.size.y * (1.0 - glm::dot(view_.up, r) * view_.cot_y / depth);
    return std::max(std::abs(place_x - (x + 0.5)), std::abs(place_y - (y + 0.5))) > reach(depth);
  }

  // How far from its place a point may be drawn, in pixels.
  double reach(double depth) const {
    return 0.5 * std::max(pixels_, std::min(splat_at_one_ / depth, PointSize::kLargestSplat)) + place_;
  }

  const FrameData& test_;
  const FrameData& reference_;
  const View& view_;
  const Grid& grid_;
  glm::dvec3 eye_;
  double pixels_;
  double splat_at_one_;
  double place_;
  double depth_;
};

// Of the pixels that both cover, row by row.
std::vector<double> depth_errors(const FrameData& test, const FrameData& reference) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < test.pixels(); ++i) {
    if (test.ids[i] == kNoPoint || reference.ids[i] == kNoPoint) continue;
    const double truth = static_cast<double>(reference.depth[i]);
    errors.push_back(std::abs(static_cast<double>(test.depth[i]) - truth) / truth);
  }
  return errors;
}

}  // namespace

FrameRates frame_rates(const FrameData& test, const FrameData& reference, const View& view, const Grid& grid,
                       const PointSize& point_size, const RateTolerances& tolerances) {
  require_same_size(test.size, reference.size);
  require_same_size(test.size, view.size);
  const Judge judge(test, reference, view, grid, point_size, tolerances);
  std::vector<Verdicts> rows(static_cast<std::size_t>(test.size.y), Verdicts{});
  tbb::parallel_for(0, test.size.y, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(test.size.x);
    Verdicts& tally = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < test.size.x; ++x) ++tally[judge.verdict(x, y, first + static_cast<std::size_t>(x))];
  });
  Verdicts total{};
  for (const Verdicts& row : rows)
    for (std::size_t v = 0; v < kVerdicts; ++v) total[v] += row[v];

  FrameRates rates;
  rates.covered_pixels = test.pixels() - total[kNothing];
  const double covered = static_cast<double>(std::max<std::uint64_t>(rates.covered_pixels, 1));
  const auto share = [&](Verdict verdict) { return static_cast<double>(total[verdict]) / covered; };
  rates.hole = share(kHole);
  rates.ghost = share(kGhost);
  rates.see_through = share(kSeeThrough);
  rates.wrong_point = share(kWrongPoint);
  const std::vector<double> errors = depth_errors(test, reference);
  if (errors.empty()) return rates;
  rates.depth_error_mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  rates.depth_error_p95 = percentile(errors, 95.0);
  return rates;
}

}  // namespace stipple
