// What the frames of a study are held against.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/frame/frame_data.h"
#include "render/measure/image.h"
#include "render/method/progressive_renderer.h"
#include "render/store/dataset.h"
#include "src/json/json.h"

namespace stipple {

// Of one view. The reference's positions and colours are left out: 18 bytes a pixel remain, so that there is room for a
// whole path.
struct Truth {
  FrameData frame;  // of the reference: ids and depth alone
  Image reference;
  std::vector<std::uint32_t> brute_force_ids;  // of the rasterizer under study
  Image brute_force;
};

// Makes them: the reference on the CPU, and brute force on the GPU, where all points lie while it lives.
class TruthMaker {
 public:
  struct Options {
    RasterizerKind raster = RasterizerKind::compute;
    PointSize point_size;
    std::uint32_t background = 0x808080;
    MethodOptions method;
  };
  // `dataset` must outlive it.
  TruthMaker(const Dataset& dataset, const Options& options);

  Truth make(const View& view);
  // How far each rasterizer, converged, is from the reference: for compute and points "pixels_different", "mse" and
  // "psnr_db"; null for one that cannot draw points of that size.
  Json rounding(const View& view, const Truth& truth);

 private:
  Image drawn_by(RasterizerKind raster, const View& view);

  const Dataset& dataset_;
  Options options_;
  std::unique_ptr<Method> everything_;
  ProgressiveRenderer renderer_;
};

}  // namespace stipple
