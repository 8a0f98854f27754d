#include "src/study/study.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "render/store/dataset.h"
#include "src/camera/camera_file.h"
#include "src/report/report.h"
#include "src/run/provenance.h"
#include "src/study/input_study.h"
#include "src/study/ledger.h"
#include "src/study/plot.h"
#include "src/study/progress.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;
// Names for folders and tables: the files' own, numbered where two are alike.
std::vector<std::string> names_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& input : inputs) {
    const std::string stem = fs::path(input).stem();
    std::string name = stem;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}-{}", stem, n);
    names.push_back(name);
  }
  return names;
}

Json limit_json(std::uint64_t bytes) {
  return bytes == MemoryLimits::kNone ? Json() : Json(bytes);
}

// What decides the results.
Json settings_json(const StudySettings& settings) {
  Json modes = Json::array();
  for (const Mode mode : settings.modes) modes.push_back(name_of(mode));
  Json regimes = Json::array();
  for (const Regime regime : settings.regimes) regimes.push_back(name_of(regime));
  const auto fps = settings.budget.frames_per_second;
  const bool timed = settings.clock == StudyClock::wall;
  return {{"regimes", regimes},
          {"clock", timed ? "wall" : "points"},
          {"modes", modes},
          {"raster", name_of(settings.raster)},
          {"width", settings.size.x},
          {"height", settings.size.y},
          {"budget_points", settings.budget.points},
          {"target_fps", fps ? Json(*fps) : Json()},
          {"steered_by", fps ? Json(settings.method.steering ? "gpu" : "cpu") : Json()},
          {"duration_s", timed ? Json(settings.seconds) : Json()},
          {"path_frames", settings.path_frames},
          {"repeats", settings.repeats},
          {"memory_bytes", limit_json(settings.method.limits.main)},
          {"gpu_memory_bytes", limit_json(settings.method.limits.gpu)},
          {"no_skip", no_skip_json(settings.method.skips)},
          {"point_size", settings.point_size.pixels},
          {"splat_size", settings.point_size.world},
          {"background", fmt::format("{:06x}", settings.background)},
          {"color", settings.color},
          {"seed", settings.method.seed},
          {"carry", settings.method.carry_indices ? "index" : "vertex"},
          {"density", settings.method.density == DensityEstimate::uniform ? "uniform" : "box-count"},
          {"flip", settings.flip_every_frame ? "every frame"
                                             : "along paths every frame, else the first, the first at 30, 35, 40, 45 "
                                               "dB, the last"},
          {"time_is",
           "drawing alone, each frame awaited; loading, upload, shader compiling and metrics excluded. Under regime "
           "loading: since reading began, all of it but metrics and what was compiled before"},
          {"warm_up", "every pass has run once on a single point, outside the clock"}};
}

// What it is that must be the same for --resume to go on.
Json ledger_json(const StudySettings& settings) {
  Json json = settings_json(settings);
  json["inputs"] = settings.inputs;
  json["version"] = program_provenance()["version"];
  Json views = Json::array();
  for (const NamedCamera& camera : settings.cameras) views.push_back(json_of(camera));
  for (const CameraPath& path : settings.paths) views.push_back(json_of(path));
  json["cameras"] = views;
  return json;
}

// Where the clouds propose them, three views and a path.
std::size_t curves_of_an_input(const StudySettings& settings) {
  const std::size_t views = settings.cameras.empty() ? 3 : settings.cameras.size();
  const std::size_t paths = settings.paths.empty() ? 1 : settings.paths.size();
  std::size_t curves = 0;
  for (const Regime regime : settings.regimes)
    curves += (of_views(regime) ? views : paths) * modes_under(regime, settings.modes).size();
  return curves * static_cast<std::size_t>(settings.repeats);
}

// Reads and studies one input, and says what it was.
Json study_input(const StudySettings& settings, const std::string& input, const std::string& name, Ledger& ledger,
                 StudyProgress& progress, Findings& findings) {
  DatasetNeeds needs;  // the reference draws all points
  for (const Mode mode : settings.modes) needs = needs | needs_of(mode, settings.method.skips);
  progress.step(fmt::format("{}: reading{}", name, needs.octree ? " and building the octree" : ""));
  const Dataset dataset = open_dataset(input, settings.color, needs, settings.method.limits);
  Json json{{"name", name}};
  json.update(dataset_provenance(dataset));
  if (const Json* before = ledger.find("dataset/" + name)) {
    if ((*before)["points_hash"] != json["points_hash"])
      throw Error(fmt::format("{}: has changed since the study began; leave out --resume to begin anew", input));
  } else {
    ledger.put("dataset/" + name, json);
  }
  json["load_ms"] = 1e3 * dataset.load_seconds;
  json["build_ms"] = 1e3 * dataset.build_seconds;
  InputStudy(settings, input, name, dataset, ledger, progress, findings).run();
  return json;
}

Json document_of(const StudySettings& settings, const HeadlessContext& context, const Json& datasets,
                 const Findings& findings, bool complete) {
  Json document{{"schema", "stipple-study"}, {"schema_version", 3}};
  document.update(program_provenance());
  document.update(context_provenance(context));
  document["settings"] = settings_json(settings);
  document["complete"] = complete;
  document["datasets"] = datasets;
  document["views"] = findings.views;
  document["paths"] = findings.paths;
  document["summary"] = findings.summaries;
  document["failures"] = findings.failures;
  return document;
}

}  // namespace

StudyResult run_study(const StudySettings& settings, const HeadlessContext& context,
                      const std::function<void(const std::string&)>& show, const std::atomic<bool>* interrupt) {
  const fs::path folder(settings.folder);
  fs::create_directories(folder);
  Ledger ledger(folder / "finished.jsonl", ledger_json(settings), settings.resume);
  StudyProgress progress(show, settings.inputs.size() * curves_of_an_input(settings), interrupt);
  const std::vector<std::string> names = names_of(settings.inputs);
  Findings findings;
  Json datasets = Json::array();
  StudyResult result;
  for (std::size_t i = 0; i < settings.inputs.size() && !result.interrupted; ++i) {
    const std::string& input = settings.inputs[i];
    try {
      datasets.push_back(study_input(settings, input, names[i], ledger, progress, findings));
    } catch (const Interrupted&) {
      result.interrupted = true;
      if (const Json* dataset = ledger.find("dataset/" + names[i])) datasets.push_back(*dataset);
    } catch (const std::exception& e) {
      // Of several inputs one may lack what the options name; of a single one, it is the options that are wrong
      if (settings.inputs.size() == 1 && dynamic_cast<const UsageError*>(&e)) throw;
      const std::string what = e.what();
      findings.failures.push_back(what.starts_with(input) ? what : input + ": " + what);
      progress.leave_out(curves_of_an_input(settings));
    }
  }

  result.document =
      document_of(settings, context, datasets, findings, !result.interrupted && findings.failures.empty());
  result.curves = std::move(findings.curves);
  result.failures = std::move(findings.failures);
  write_file(folder / "curves.csv", curves_csv(result.curves));
  write_file(folder / "study.json", text_of(result.document, 2) + "\n");
  write_file(folder / "plot.svg", plot_svg(result.curves));
  show("report");
  write_file(folder / "index.html", report_html(result.document, result.curves, settings.folder));
  return result;
}

}  // namespace stipple
