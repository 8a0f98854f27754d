#include "src/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "render/measure/flip.h"
#include "render/measure/psnr.h"
#include "render/measure/ssim.h"
#include "render/method/progressive_renderer.h"
#include "render/reference/reference.h"
#include "render/store/dataset.h"
#include "src/camera/camera_file.h"
#include "src/run/provenance.h"
#include "src/study/plot.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;
using Progress = std::function<void(const std::string&)>;

// What the curves of one view are held against.
struct Truth {
  FrameData frame;
  Image reference;
  FrameData brute_force;
};

// Frames kept as pictures: the first, the last, and whenever the points drawn have doubled.
class FrameKeeper {
 public:
  FrameKeeper(fs::path folder, std::string provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {
    // Frames of an earlier study would pass for this one's
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void offer(const FrameState& state, const Image& image) {
    if (state.points_drawn >= next_) keep(state, image);
  }
  void keep(const FrameState& state, const Image& image) {
    next_ = 2 * state.points_drawn;
    write_png(folder_ / fmt::format("{:05}.png", state.frame), image,
              {{"stipple", provenance_}, {"points_drawn", std::to_string(state.points_drawn)}});
  }

 private:
  fs::path folder_;
  std::string provenance_;
  std::uint64_t next_ = 0;
};

class InputStudy {
 public:
  InputStudy(const StudySettings& settings, std::string name, const Dataset& dataset, const Progress& progress)
      : settings_(settings), name_(std::move(name)), dataset_(dataset), progress_(progress) {}

  void run(std::vector<Curve>& curves, Json& summaries, Json& views) {
    const double aspect = static_cast<double>(settings_.size.x) / settings_.size.y;
    const std::vector<NamedCamera> cameras =
        settings_.cameras.empty() ? propose_cameras(dataset_.overview(), aspect) : settings_.cameras;
    for (const NamedCamera& camera : cameras) {
      const View view = make_view(camera.camera, settings_.size, near_plane(dataset_.points.grid));
      const Truth truth = truth_of(camera.name, view);
      views.push_back(view_json(camera, view, truth));
      for (const Mode mode : settings_.modes) {
        const std::size_t first = curves.size();
        for (int repeat = 0; repeat < settings_.repeats; ++repeat)
          curves.push_back(draw_curve(camera.name, view, mode, repeat, truth));
        summaries.push_back(summary_json(std::span(curves).subspan(first)));
      }
    }
  }

 private:
  fs::path folder(const char* kind) const { return fs::path(settings_.folder) / kind / name_; }

  std::unique_ptr<Method> method(Mode mode) const { return make_method(mode, dataset_, settings_.method); }

  Truth truth_of(const std::string& view_name, const View& view) {
    progress_(fmt::format("{}, {}: reference", name_, view_name));
    Truth truth;
    truth.frame = render_reference(dataset_.points, view, settings_.point_size);
    truth.reference = compose(truth.frame, settings_.background);
    fs::create_directories(folder("reference"));
    write_png(folder("reference") / (view_name + ".png"), truth.reference,
              {{"stipple", text_of(view_provenance(view))}});

    const auto everything = method(Mode::brute_force);
    ProgressiveRenderer renderer(*everything, settings_.raster, dataset_.points.grid, settings_.point_size);
    renderer.draw(view, 0);
    truth.brute_force = renderer.read();
    return truth;
  }

  Json view_json(const NamedCamera& camera, const View& view, const Truth& truth) const {
    const Image brute_force = compose(truth.brute_force, settings_.background);
    std::size_t different = 0;
    for (std::size_t i = 0; i < brute_force.rgb.size(); i += 3)
      different += !std::equal(&brute_force.rgb[i], &brute_force.rgb[i] + 3, &truth.reference.rgb[i]) ? 1u : 0u;
    Json json = json_of(camera);
    json["dataset"] = name_;
    json["near"] = view.near;
    json["covered_pixels"] = truth.brute_force.covered_pixels();
    json["brute_force_pixels_different_from_reference"] = different;
    json["brute_force_psnr_db"] = json_of_any(psnr_db(mean_squared_error(brute_force, truth.reference)));
    return json;
  }

  // All but FLIP, which costs more than most frames.
  CurvePoint judged(const FrameState& state, const FrameData& frame, const Image& image, const View& view,
                    const Truth& truth) const {
    return {.state = state,
            .mse = mean_squared_error(image, truth.reference),
            .covered_mse = covered_mean_squared_error(image, truth.reference, truth.frame.ids),
            .ssim = ssim(image, truth.reference),
            .flip = {},
            .rates = frame_rates(frame, truth.frame, view, dataset_.points.grid, settings_.point_size),
            .identical = frame.ids == truth.brute_force.ids};
  }

  Curve draw_curve(const std::string& view_name, const View& view, Mode mode, int repeat, const Truth& truth) {
    progress_(fmt::format("{}, {}: {}{}", name_, view_name, name_of(mode),
                          settings_.repeats > 1 ? fmt::format(", repeat {}", repeat + 1) : ""));
    Curve curve{name_, view_name, std::string(name_of(mode)), std::string(name_of(settings_.raster)), repeat, {}};
    const Json provenance{{"dataset", dataset_provenance(dataset_)},
                          {"view", view_provenance(view)},
                          {"mode", curve.mode},
                          {"raster", curve.raster},
                          {"seed", settings_.method.seed}};
    std::optional<FrameKeeper> keeper;
    if (repeat == 0) keeper.emplace(folder("frames") / view_name / curve.mode, text_of(provenance));
    const auto drawn = method(mode);
    ProgressiveRenderer renderer(*drawn, settings_.raster, dataset_.points.grid, settings_.point_size);
    QualityMarks marks;
    const auto observe = [&](const FrameState& state) {
      const FrameData frame = renderer.read();
      const Image image = compose(frame, settings_.background);
      CurvePoint& point = curve.points.emplace_back(judged(state, frame, image, view, truth));
      if (marks.passes(psnr_db(point.mse)) || settings_.flip_every_frame) point.flip = flip(image, truth.reference);
      if (keeper) keeper->offer(state, image);
    };
    const FrameState end =
        run_view(renderer, view, settings_.budget, {.frames = {}, .milliseconds = 1e3 * settings_.seconds}, observe);
    const Image last = compose(renderer.read(), settings_.background);
    if (!curve.points.back().flip) curve.points.back().flip = flip(last, truth.reference);
    if (keeper) keeper->keep(end, last);
    return curve;
  }

  const StudySettings& settings_;
  std::string name_;
  const Dataset& dataset_;
  const Progress& progress_;
};

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

Json settings_json(const StudySettings& settings) {
  Json modes = Json::array();
  for (const Mode mode : settings.modes) modes.push_back(name_of(mode));
  Json json{{"regime", "cold start, still camera"},
            {"modes", modes},
            {"raster", name_of(settings.raster)},
            {"width", settings.size.x},
            {"height", settings.size.y},
            {"budget_points", settings.budget.points},
            {"target_fps", settings.budget.frames_per_second ? Json(*settings.budget.frames_per_second) : Json()},
            {"duration_s", settings.seconds},
            {"repeats", settings.repeats},
            {"skip_occluded", settings.method.skip_occluded},
            {"by_yield", settings.method.by_yield},
            {"point_size", settings.point_size},
            {"background", fmt::format("{:06x}", settings.background)},
            {"seed", settings.method.seed},
            {"flip", settings.flip_every_frame ? "every frame" : "first frame, first at 30, 35, 40, 45 dB, last"}};
  json["clock"] = "drawing alone, each frame awaited; loading, upload, shader compiling and metrics excluded";
  return json;
}

}  // namespace

StudyResult run_study(const StudySettings& settings, const HeadlessContext& context, const Progress& progress) {
  fs::create_directories(settings.folder);
  DatasetNeeds needs;  // the reference draws all points
  for (const Mode mode : settings.modes) needs = needs | needs_of(mode);
  const std::vector<std::string> names = names_of(settings.inputs);
  std::vector<Curve> curves;
  Json datasets = Json::array();
  Json views = Json::array();
  Json summaries = Json::array();
  StudyResult result;
  for (std::size_t i = 0; i < settings.inputs.size(); ++i) {
    try {
      progress(fmt::format("{}: reading{}", names[i], needs.octree ? " and building the octree" : ""));
      const Dataset dataset = open_dataset(settings.inputs[i], settings.color, needs, settings.method.limits);
      InputStudy(settings, names[i], dataset, progress).run(curves, summaries, views);
      Json json{{"name", names[i]}};
      json.update(dataset_provenance(dataset));
      json["load_ms"] = 1e3 * dataset.load_seconds;
      json["build_ms"] = 1e3 * dataset.build_seconds;
      datasets.push_back(json);
    } catch (const std::exception& e) {
      // Of several inputs one may lack what the options name; of a single one, it is the options that are wrong
      if (settings.inputs.size() == 1 && dynamic_cast<const UsageError*>(&e)) throw;
      const std::string what = e.what();
      result.failures.push_back(what.starts_with(settings.inputs[i]) ? what : settings.inputs[i] + ": " + what);
    }
  }

  result.document = {{"schema", "stipple-study"}, {"schema_version", 1}};
  result.document.update(program_provenance());
  result.document.update(context_provenance(context));
  result.document["settings"] = settings_json(settings);
  result.document["datasets"] = datasets;
  result.document["views"] = views;
  result.document["summary"] = summaries;
  result.document["failures"] = result.failures;
  const fs::path folder(settings.folder);
  write_file(folder / "curves.csv", curves_csv(curves));
  write_file(folder / "study.json", text_of(result.document, 2) + "\n");
  write_file(folder / "plot.svg", plot_svg(curves));
  return result;
}

}  // namespace stipple
