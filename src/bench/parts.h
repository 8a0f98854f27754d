// The parts of the program, timed one by one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "render/method/method.h"
#include "render/store/dataset.h"
#include "src/bench/timing.h"
#include "src/run/view_run.h"

namespace stipple {

struct BenchSettings {
  glm::ivec2 size{1280, 720};
  std::uint32_t budget = 1'000'000;  // points a frame of the progressive parts
  int repeats = 5;
};

using TimingSink = std::function<void(const Timing&)>;

// Reading: positions and colour, everything, and into memory.
void bench_reading(const PointSource& source, const BenchSettings& settings, const TimingSink& sink);

// Building an octree on disk from the source, in the temporary folder: with each sampling, and with little memory.
void bench_building(const PointSource& source, const BenchSettings& settings, const TimingSink& sink);

// Building the octree in memory, and the reference renderer.
void bench_processing(const Dataset& dataset, const BenchSettings& settings, const TimingSink& sink);

// What it takes a method to reach a quality.
struct QualityRow {
  Mode mode = Mode::hybrid;
  // To 30, 35, 40, 45 dB (kQualities) and to the picture of brute force; empty where it does not get there. The amount
  // is that of points drawn, which is equal in all runs.
  std::vector<std::optional<Timing>> reached;
};

// Time against error: each method draws the oblique view with `budget` points a frame from nothing, held against the
// reference. The dataset must have its octree. At most 3 runs. `show` gets each row. Needs a context.
void bench_quality(const Dataset& dataset, const BenchSettings& settings,
                   const std::function<void(const QualityRow&)>& show);

// For each rasterizer: brute force, and the parts of a progressive frame in the middle of converging. Needs a context.
void bench_drawing(const Dataset& dataset, const BenchSettings& settings, const TimingSink& sink);

}  // namespace stipple
