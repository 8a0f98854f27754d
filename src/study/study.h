// All methods on the same data, views and budget, each frame held against one exact reference.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "render/frame/propose_views.h"
#include "render/gpu/context.h"
#include "render/raster/rasterizer.h"
#include "src/camera/camera_path.h"
#include "src/json/json.h"
#include "src/run/view_run.h"
#include "src/study/curve.h"
#include "src/study/regime.h"

namespace stipple {

// What a study counts work by.
enum class StudyClock {
  wall,    // time of drawing, and points beside it
  points,  // points drawn alone: nothing that is written depends on time
};

struct StudySettings {
  std::vector<std::string> inputs;
  std::string folder;  // for everything the study writes
  std::vector<Mode> modes;
  std::vector<Regime> regimes{Regime::cold, Regime::path};
  StudyClock clock = StudyClock::wall;
  std::vector<NamedCamera> cameras;  // empty: proposed for each cloud
  std::vector<CameraPath> paths;     // empty: one proposed for each cloud
  int path_frames = 25;              // evenly spaced in time, 2 or more
  glm::ivec2 size{1280, 720};
  RasterizerKind raster = RasterizerKind::compute;
  BudgetPolicy budget;
  MethodOptions method;
  double seconds = 120.0;  // of drawing, at most, for each curve by the wall clock
  int repeats = 1;
  PointSize point_size;
  std::string color;
  std::uint32_t background = 0x808080;
  bool flip_every_frame = false;  // or only at QualityMarks, along paths, and the last frame
  bool resume = false;            // go on with what an earlier run into the same folder has finished
};

struct StudyResult {
  Json document;  // what study.json holds
  std::vector<Curve> curves;
  std::vector<std::string> failures;  // inputs or methods that could not be studied, and why
  bool interrupted = false;
};

// For each input, view and regime (DESIGN names them; see regime.h): the reference picture, the brute-force picture,
// and for each mode its curve. Loading, upload, shader compiling and what comes before a jump or a stop are outside the
// clock, metrics too. Writes into the folder: index.html, curves.csv, study.json, plot.svg, reference/, frames/, and
// finished.jsonl, by which `resume` goes on. An input or a method that fails is reported, and the rest go on.
// `progress` gets a line for every step. Once `interrupt` is true the study ends, and what it has finished is written.
// Throws Error when the folder cannot be written, UsageError when the only input cannot be studied with these settings.
StudyResult run_study(const StudySettings& settings, const HeadlessContext& context,
                      const std::function<void(const std::string&)>& progress,
                      const std::atomic<bool>* interrupt = nullptr);

}  // namespace stipple
