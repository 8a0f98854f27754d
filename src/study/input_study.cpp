#include "src/study/input_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "octree/core/error.h"
#include "src/camera/camera_file.h"
#include "src/run/provenance.h"
#include "src/study/curve_drawing.h"
#include "src/study/curve_json.h"
#include "src/study/frame_keeper.h"
#include "src/study/loading_curve.h"
#include "src/study/summary.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;

// Pictures kept of a path.
constexpr int kKeptOfAPath = 6;

// T16's comparisons stand or fall with it: points read in order from a tree, or shuffled.
std::string reading_order_of(Mode mode) {
  switch (mode) {
    case Mode::brute_force:
      return "all, in store order";
    case Mode::hierarchical:
      return "ordered: clusters front to back, shuffled in each";
    case Mode::unstructured:
      return "shuffled: the whole cloud";
    case Mode::hybrid:
      return "ordered: clusters by the pixels they win, shuffled in each";
    case Mode::lod:
      return "ordered: nodes by the distance of their points on the screen, all again every frame";
    case Mode::subsample:
      return "shuffled: the whole cloud, from its beginning for each view";
  }
  return "";
}

std::vector<Regime> chosen(const std::vector<Regime>& regimes, bool views) {
  std::vector<Regime> result;
  std::ranges::copy_if(regimes, std::back_inserter(result), [views](Regime r) { return of_views(r) == views; });
  return result;
}

}  // namespace

InputStudy::InputStudy(const StudySettings& settings, std::string input, std::string name, const Dataset& dataset,
                       Ledger& ledger, StudyProgress& progress, Findings& findings)
    : settings_(settings),
      input_(std::move(input)),
      name_(std::move(name)),
      dataset_(dataset),
      ledger_(ledger),
      progress_(progress),
      findings_(findings),
      cameras_(settings.cameras),
      paths_(settings.paths) {
  if (!cameras_.empty() && !paths_.empty()) return;
  const double aspect = static_cast<double>(settings.size.x) / settings.size.y;
  const std::vector<NamedCamera> proposed = propose_cameras(dataset.overview(), aspect);
  if (cameras_.empty()) cameras_ = proposed;
  if (paths_.empty()) paths_ = {propose_path(proposed)};
}

View InputStudy::view_of(const Camera& camera) const {
  return make_view(camera, settings_.size, near_plane(dataset_.points.grid));
}

std::vector<Route> InputStudy::routes() const {
  const auto fps = settings_.budget.frames_per_second;
  const double fps_ms = fps ? 1e3 / *fps : 0.0;
  std::vector<Route> routes;
  if (const auto regimes = chosen(settings_.regimes, true); !regimes.empty())
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const std::size_t before = (i + cameras_.size() - 1) % cameras_.size();
      routes.push_back({.name = cameras_[i].name,
                        .views = {view_of(cameras_[i].camera)},
                        .regimes = regimes,
                        .jumps_from = view_of(cameras_[before].camera),
                        .target_ms = fps_ms});
    }
  if (const auto regimes = chosen(settings_.regimes, false); !regimes.empty())
    for (const CameraPath& path : paths_) {
      Route route{.name = path.name, .views = {}, .regimes = regimes, .jumps_from = {}, .target_ms = fps_ms};
      for (const Camera& camera : cameras_along(path, settings_.path_frames)) route.views.push_back(view_of(camera));
      if (!fps) route.target_ms = 1e3 * path.duration() / (settings_.path_frames - 1);
      routes.push_back(std::move(route));
    }
  return routes;
}

void InputStudy::run() {
  for (const Route& route : routes()) study(route);
}

std::string InputStudy::key(const Route& route, Regime regime, Mode mode, int repeat) const {
  return fmt::format("{}/{}/{}/{}/{}", name_, name_of(regime), route.name, name_of(mode), repeat);
}

std::string InputStudy::folder(const std::string& kind, const std::string& name) const {
  return fmt::format("{}/{}/{}", kind, name_, name);
}

bool InputStudy::finished(const Route& route) const {
  for (const Regime regime : route.regimes)
    for (const Mode mode : modes_under(regime, settings_.modes))
      for (int repeat = 0; repeat < settings_.repeats; ++repeat)
        if (!ledger_.find(key(route, regime, mode, repeat))) return false;
  return ledger_.find(folder(route.is_path() ? "path" : "view", route.name)) != nullptr;
}

void InputStudy::study(const Route& route) {
  const std::string description_key = folder(route.is_path() ? "path" : "view", route.name);
  Json description;
  std::vector<Truth> truths;
  if (finished(route)) {
    description = *ledger_.find(description_key);
  } else {
    truths = truths_of(route, description);
    ledger_.put(description_key, description);
  }
  (route.is_path() ? findings_.paths : findings_.views).push_back(description);
  for (const Regime regime : route.regimes)
    for (const Mode mode : modes_under(regime, settings_.modes)) study_mode(route, regime, mode, truths);
}

// The reference pictures go to files here.
std::vector<Truth> InputStudy::truths_of(const Route& route, Json& description) const {
  progress_.step(fmt::format("{}, {}: reference{}", name_, route.name, route.is_path() ? "s" : ""));
  // DIR/NAME.png, of a path DIR/NAME/00001.png and on
  const fs::path pictures = fs::path(settings_.folder) / folder("reference", route.name);
  fs::create_directories(pictures.parent_path());
  if (route.is_path()) {
    fs::remove_all(pictures);
    fs::create_directories(pictures);
  }
  TruthMaker maker(dataset_, {.raster = settings_.raster,
                              .point_size = settings_.point_size,
                              .background = settings_.background,
                              .method = settings_.method});
  std::vector<Truth> truths;
  for (const View& view : route.views) {
    progress_.check();
    truths.push_back(maker.make(view));
    const fs::path file =
        route.is_path() ? pictures / fmt::format("{:05}.png", truths.size()) : fs::path(pictures.string() + ".png");
    const Json provenance{{"mode", "reference"},
                          {"dataset", dataset_provenance(dataset_)},
                          {"view", view_provenance(view)},
                          {"point_size", settings_.point_size.pixels},
                          {"splat_size", settings_.point_size.world},
                          {"background", fmt::format("{:06x}", settings_.background)}};
    write_png(file, truths.back().reference, {{"stipple", text_of(provenance)}});
  }
  description = describe(route, maker, truths.back());
  return truths;
}

// `last`: of a path, that of its last frame.
Json InputStudy::describe(const Route& route, TruthMaker& maker, const Truth& last) const {
  Json json = route.is_path() ? json_of(*std::ranges::find(paths_, route.name, &CameraPath::name))
                              : json_of(*std::ranges::find(cameras_, route.name, &NamedCamera::name));
  json["dataset"] = name_;
  if (route.is_path()) json["frames"] = route.views.size();
  json["near"] = route.views.back().near;
  const auto background = static_cast<std::size_t>(std::ranges::count(last.brute_force_ids, kNoPoint));
  json["covered_pixels"] = last.brute_force_ids.size() - background;
  json["rounding"] = maker.rounding(route.views.back(), last);
  return json;
}

void InputStudy::study_mode(const Route& route, Regime regime, Mode mode, const std::vector<Truth>& truths) {
  const auto repeats = static_cast<std::size_t>(settings_.repeats);
  std::vector<Curve> curves;
  try {
    for (int repeat = 0; repeat < settings_.repeats; ++repeat)
      curves.push_back(curve(route, regime, mode, repeat, truths));
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& e) {
    progress_.leave_out(repeats - curves.size());
    findings_.failures.push_back(
        fmt::format("{}, {}, {}, {}: {}", name_, name_of(regime), route.name, name_of(mode), e.what()));
    return;
  }
  Json summary = summary_json(curves, route.target_ms, dataset_.info.point_count);
  summary["reads"] = reading_order_of(mode);
  findings_.summaries.push_back(summary);
  std::ranges::move(curves, std::back_inserter(findings_.curves));
}

Curve InputStudy::curve(const Route& route, Regime regime, Mode mode, int repeat, const std::vector<Truth>& truths) {
  const std::string ledger_key = key(route, regime, mode, repeat);
  if (const Json* finished = ledger_.find(ledger_key)) {
    progress_.leave_out(1);
    return curve_from(*finished);
  }
  progress_.begin_curve(fmt::format("{}, {}, {}: {}{}", name_, name_of(regime), route.name, name_of(mode),
                                    settings_.repeats > 1 ? fmt::format(", repeat {}", repeat + 1) : ""));
  Curve drawn = draw(route, regime, mode, repeat, truths);
  ledger_.put(ledger_key, json_of(drawn));
  progress_.end_curve();
  return drawn;
}

std::string InputStudy::provenance(const Route& route, const Curve& curve) const {
  Json json{{"dataset", dataset_provenance(dataset_)},
            {"regime", curve.regime},
            {"route", route.name},
            {"view", view_provenance(route.views.back())},
            {"mode", curve.mode},
            {"raster", curve.raster},
            {"budget", settings_.budget.points},
            {"point_size", settings_.point_size.pixels},
            {"splat_size", settings_.point_size.world},
            {"background", fmt::format("{:06x}", settings_.background)},
            {"seed", settings_.method.seed},
            {"carry", settings_.method.carry_indices ? "index" : "vertex"},
            {"density", settings_.method.density == DensityEstimate::uniform ? "uniform" : "box-count"}};
  // That of a picture on a path is where the path has it in that frame
  if (curve.regime == name_of(Regime::path)) {
    json.erase("view");
    json["path"] = json_of(*std::ranges::find(paths_, route.name, &CameraPath::name));
    json["path_frames"] = route.views.size();
  }
  json.update(program_provenance());
  return text_of(json);
}

Curve InputStudy::draw(const Route& route, Regime regime, Mode mode, int repeat, const std::vector<Truth>& truths) {
  if (settings_.clock == StudyClock::points && dataset_.tree && regime != Regime::loading && !needs_of(mode).points)
    throw Error(
        "what it draws of an octree on disk in a frame depends on how fast the disk is, so that it cannot be counted "
        "by points alone; give the points as a file, or leave out --clock points");
  Curve curve{name_, route.name, std::string(name_of(mode)), std::string(name_of(settings_.raster)), repeat, {}};
  curve.regime = name_of(regime);
  curve.timed = settings_.clock == StudyClock::wall;

  std::optional<FrameKeeper> keeper;
  if (repeat == 0) {
    const auto every = static_cast<std::uint64_t>(std::max(1, (settings_.path_frames - 1) / (kKeptOfAPath - 1)));
    keeper.emplace(settings_.folder, fs::path("frames") / name_ / curve.regime / route.name / curve.mode,
                   provenance(route, curve), regime == Regime::path ? every : 0);
  }
  FrameKeeper* const keeping = keeper ? &*keeper : nullptr;
  curve.points =
      regime == Regime::loading
          ? draw_while_loading(settings_, input_, dataset_, mode, progress_, route.views.back(), truths.back(), keeping)
          : CurveDrawing(settings_, dataset_, mode, progress_).run(regime, route, truths, keeping);
  if (keeper) curve.kept = keeper->kept();
  return curve;
}

}  // namespace stipple
