#include "src/study/truth.h"

#include <algorithm>

#include "octree/core/error.h"
#include "render/measure/psnr.h"
#include "render/reference/reference.h"

namespace stipple {
namespace {

std::size_t pixels_different(const Image& a, const Image& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    different += !std::equal(&a.rgb[i], &a.rgb[i] + 3, &b.rgb[i]) ? 1u : 0u;
  return different;
}

}  // namespace

TruthMaker::TruthMaker(const Dataset& dataset, const Options& options)
    : dataset_(dataset),
      options_(options),
      everything_(make_method(Mode::brute_force, dataset, options.method)),
      renderer_(*everything_, options.raster, dataset.points.grid, options.point_size) {}

Truth TruthMaker::make(const View& view) {
  Truth truth;
  truth.frame = render_reference(dataset_.points, view, options_.point_size);
  truth.reference = compose(truth.frame, options_.background);
  truth.frame.positions = {};
  truth.frame.rgba = {};
  renderer_.draw(view, 0);
  FrameData drawn = renderer_.read();
  truth.brute_force = compose(drawn, options_.background);
  truth.brute_force_ids = std::move(drawn.ids);
  return truth;
}

Image TruthMaker::drawn_by(RasterizerKind raster, const View& view) {
  ProgressiveRenderer renderer(*everything_, raster, dataset_.points.grid, options_.point_size);
  renderer.draw(view, 0);
  return compose(renderer.read(), options_.background);
}

Json TruthMaker::rounding(const View& view, const Truth& truth) {
  Json json;
  for (const RasterizerKind raster : {RasterizerKind::compute, RasterizerKind::points}) {
    Json& entry = json[std::string(name_of(raster))];
    try {
      const Image image = raster == options_.raster ? truth.brute_force : drawn_by(raster, view);
      const double mse = mean_squared_error(image, truth.reference);
      entry = {{"pixels_different", pixels_different(image, truth.reference)},
               {"mse", mse},
               {"psnr_db", json_of_any(psnr_db(mse))}};
    } catch (const UsageError&) {
      entry = nullptr;
    }
  }
  return json;
}

}  // namespace stipple
