// Quality against work: one method drawing one view from nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/json/json.h"
#include "src/run/view_run.h"

namespace stipple {

// A frame and how far it is from the reference picture.
struct CurvePoint {
  FrameState state;
  double mse = 0.0;        // over the image, channels 0 to 255
  bool identical = false;  // to the brute-force picture of the same rasterizer, in every pixel and id
};

struct Curve {
  std::string dataset;
  std::string view;
  std::string mode;
  std::string raster;
  int repeat = 0;
  std::vector<CurvePoint> points;
};

// The work after which a curve first reaches a quality.
struct Reached {
  std::uint64_t points_drawn = 0;
  double milliseconds = 0.0;
};

// The first frame with at least `psnr_db`.
std::optional<Reached> reaches(const Curve& curve, double psnr_db);
// The first frame identical to brute force.
std::optional<Reached> reaches_identical(const Curve& curve);

// The decibels a summary asks for.
inline constexpr double kQualities[] = {30.0, 35.0, 40.0, 45.0};

// A header line, then a line a frame: dataset, view, mode, raster, repeat, frame, budget, points_drawn,
// points_reprojected, ms, covered_pixels, mse, psnr_db (inf when identical to the reference), identical, converged.
std::string curves_csv(std::span<const Curve> curves);

// Of the repeats of one mode and view: work to each quality (medians, and the spread of the times),
// final quality and whether it ended identical to brute force.
Json summary_json(std::span<const Curve> repeats);

}  // namespace stipple
