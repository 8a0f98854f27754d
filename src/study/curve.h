// Quality against work: one method drawing one view or path.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/measure/error_parts.h"
#include "render/measure/frame_rates.h"
#include "src/run/view_run.h"

namespace stipple {

// A frame and how far it is from the reference picture.
struct CurvePoint {
  FrameState state;
  double mse = 0.0;          // over the image, channels 0 to 255
  double covered_mse = 0.0;  // over the pixels that the reference covers
  std::optional<double> ssim;
  std::optional<double> flip;  // where it was measured
  FrameRates rates;
  bool identical = false;         // to the brute-force picture of the same rasterizer, in every pixel and id
  ErrorParts parts;               // of mse
  std::optional<double> reuse;    // share of the covered pixels whose point the frame before showed
  std::optional<double> flicker;  // against the frame before
};

// A frame that was kept as a picture.
struct KeptFrame {
  std::uint64_t frame = 0;
  std::string file;  // below the study's folder
};

struct Curve {
  std::string dataset;
  std::string view;  // or path
  std::string mode;
  std::string raster;
  int repeat = 0;
  std::vector<CurvePoint> points;
  std::string regime = "cold";
  bool timed = true;  // or nobody looked at the clock: milliseconds mean nothing
  std::vector<KeptFrame> kept{};
};

// The work after which a curve first reaches a quality.
struct Reached {
  std::uint64_t points_drawn = 0;
  double milliseconds = 0.0;
  std::optional<double> ssim;  // of that frame
  std::optional<double> flip;
};

// The first frame with at least `psnr_db`.
std::optional<Reached> reaches(const Curve& curve, double psnr_db);
// The first frame identical to brute force.
std::optional<Reached> reaches_identical(const Curve& curve);

// The first frame at whose beginning all points were loaded, of a curve drawn while they were.
std::optional<Reached> reaches_all_loaded(const Curve& curve, std::uint64_t points_total);

// The decibels a summary asks for.
inline constexpr double kQualities[] = {30.0, 35.0, 40.0, 45.0};

// Tells the first frame of a curve and those that are the first to reach one of kQualities: the frames worth the dearer
// measurements.
class QualityMarks {
 public:
  // Once for each frame in turn.
  bool passes(double psnr_db);

 private:
  int reached_ = -1;  // qualities; none yet seen
};

// A header line, then a line a frame; docs/study.md says what the columns are. psnr_db is inf when identical to the
// reference; what was not measured is empty.
std::string curves_csv(std::span<const Curve> curves);

}  // namespace stipple
