#include "render/store/point_supply.h"

#include "render/frame/view_frustum.h"

namespace stipple {

double PointSupply::estimate(const Cluster& cluster, const WorldBox& box, double root_edge, const View& view) const {
  const double pixel_size = nearest_pixel_size(view, box);
  return density_ == DensityEstimate::uniform ? uniform_pixels(box, cluster.count, view.forward, pixel_size)
                                              : estimated_pixels(cluster.profile, root_edge, pixel_size);
}

}  // namespace stipple
