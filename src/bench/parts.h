// The parts of the program, timed one by one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "render/store/dataset.h"
#include "src/bench/stopwatch.h"
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

// For each rasterizer: brute force, and the parts of a progressive frame in the middle of converging. Needs a context.
void bench_drawing(const Dataset& dataset, const BenchSettings& settings, const TimingSink& sink);

}  // namespace stipple
