#include "render/raster/rasterizer.h"

#include <array>

#include "render/raster/compute_rasterizer.h"
#include "render/raster/points_rasterizer.h"

namespace stipple {
namespace {

constexpr std::array kKinds{RasterizerKind::points, RasterizerKind::compute};

}  // namespace

std::unique_ptr<Rasterizer> make_rasterizer(RasterizerKind kind, bool splats) {
  if (kind == RasterizerKind::points) return std::make_unique<PointsRasterizer>(splats);
  return std::make_unique<ComputeRasterizer>(splats);
}

std::string_view name_of(RasterizerKind kind) {
  return kind == RasterizerKind::points ? "points" : "compute";
}

std::optional<RasterizerKind> rasterizer_named(std::string_view name) {
  for (const RasterizerKind kind : kKinds)
    if (name_of(kind) == name) return kind;
  return std::nullopt;
}

}  // namespace stipple
