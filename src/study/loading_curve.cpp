#include "src/study/loading_curve.h"

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "render/measure/flip.h"
#include "render/store/replayed_arrivals.h"
#include "src/run/loading_run.h"
#include "src/study/frame_judge.h"

namespace stipple {
namespace {

std::vector<CurvePoint> judged_frames(LoadingDrawing& drawing, const StudySettings& settings, const Grid& grid,
                                      const StudyProgress& progress, const View& view, const Truth& truth,
                                      FrameKeeper* keeper) {
  Until until;
  if (settings.clock == StudyClock::wall) until.milliseconds = 1e3 * settings.seconds;
  FrameJudge judge(grid, {.point_size = settings.point_size, .flip_every_frame = settings.flip_every_frame});
  std::vector<CurvePoint> points;
  Image image;
  do {
    const FrameState& state = drawing.draw(view);
    progress.check();
    const FrameData frame = drawing.renderer().read();
    image = compose(frame, settings.background);
    points.push_back(judge.judge(state, frame, image, view, truth));
    if (keeper) keeper->offer(state, image);
  } while (!ended(until, points.back().state));
  CurvePoint& last = points.back();
  if (!last.flip) last.flip = flip(image, truth.reference);
  if (keeper) keeper->keep(last.state, image);
  return points;
}

}  // namespace

std::vector<CurvePoint> draw_while_loading(const StudySettings& settings, const std::string& input,
                                           const Dataset& dataset, Mode mode, const StudyProgress& progress,
                                           const View& view, const Truth& truth, FrameKeeper* keeper) {
  if (dataset.tree)
    throw Error("an octree is drawn from disk at once, and not while it is loaded; give the points as a file");
  const Grid& grid = dataset.points.grid;
  if (settings.clock == StudyClock::points) {
    ReplayedArrivals replayed(dataset);
    LoadingDrawing drawing(replayed, mode, settings.method, settings.raster, grid, settings.point_size, settings.budget,
                           view);
    return judged_frames(drawing, settings, grid, progress, view, truth, keeper);
  }
  const auto source = open_source(input);
  BackgroundLoad load(*source, {dataset.colors.attribute, dataset.colors.ramp, dataset.colors.hidden});
  LoadingDrawing drawing(load, mode, settings.method, settings.raster, grid, settings.point_size, settings.budget,
                         view);
  return judged_frames(drawing, settings, grid, progress, view, truth, keeper);
}

}  // namespace stipple
