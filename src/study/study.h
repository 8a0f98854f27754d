// All methods on the same data, views and budget, each frame held against one exact reference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/frame/propose_views.h"
#include "render/gpu/context.h"
#include "render/raster/rasterizer.h"
#include "src/json/json.h"
#include "src/run/view_run.h"
#include "src/study/curve.h"

namespace stipple {

struct StudySettings {
  std::vector<std::string> inputs;
  std::string folder;  // for everything the study writes
  std::vector<Mode> modes;
  std::vector<NamedCamera> cameras;  // empty: proposed for each cloud
  glm::ivec2 size{1280, 720};
  RasterizerKind raster = RasterizerKind::compute;
  BudgetPolicy budget;
  MethodOptions method;
  double seconds = 120.0;  // of drawing, at most, for each curve
  int repeats = 1;
  double point_size = 1.0;
  std::string color;
  std::uint32_t background = 0x808080;
  bool flip_every_frame = false;  // or only at QualityMarks and the last frame
};

struct StudyResult {
  Json document;                      // what study.json holds
  std::vector<std::string> failures;  // inputs that could not be studied, and why
};

// Regime: cold start, still camera (Tredinnick and others 2016, section 5). For each input and view: the reference
// picture, the brute-force picture, and for each mode its curve. Loading, upload and shader compiling are outside the
// clock, metrics too. Writes into the folder: curves.csv, study.json, plot.svg, reference/, frames/. An input that
// fails is reported, and the rest go on. `progress` gets a line for every step. Throws Error when the folder cannot be
// written.
StudyResult run_study(const StudySettings& settings, const HeadlessContext& context,
                      const std::function<void(const std::string&)>& progress);

}  // namespace stipple
