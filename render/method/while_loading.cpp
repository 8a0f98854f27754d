#include "render/method/while_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "octree/core/error.h"
#include "render/store/cluster_cloud.h"

namespace stipple {
namespace {

void check_room_while_loading(Mode mode, std::size_t points, const MemoryLimits& limits) {
  std::uint64_t bytes = points * kGpuBytesPerPoint;
  // When it goes over to clusters, both are there for a moment
  if (mode == Mode::hybrid) bytes += cluster_bytes_for(points);
  if (bytes > limits.gpu)
    throw Error(
        fmt::format("mode {} keeps all {} points on the GPU, while loading {} bytes, and {} are allowed. Allow more "
                    "with --gpu-memory, or build an octree (stipple build) and draw it in mode hierarchical.",
                    name_of(mode), points, bytes, limits.gpu));
}

}  // namespace

bool draws_while_loading(Mode mode) {
  return mode == Mode::unstructured || mode == Mode::hybrid;
}

WhileLoading::WhileLoading(PointArrivals& arrivals, Mode mode, const Options& options)
    : arrivals_(arrivals), mode_(mode), options_(options) {
  check_room_while_loading(mode, arrivals.total(), options.method.limits);
  const bool as_s18 = mode == Mode::unstructured && options.method.carry_indices;
  const bool as_s19 = mode == Mode::unstructured && !options.method.carry_indices;
  arriving_ = std::make_unique<Arriving>(arrivals.total(), as_s19 ? ArrivalOrder::permuted : ArrivalOrder::displaced,
                                         options.method.seed, as_s18 ? Carry::indices : Carry::vertices,
                                         mode == Mode::unstructured ? options.method.steering : std::nullopt);
}

void WhileLoading::advance(ProgressiveRenderer& renderer) {
  if (!whole_) {
    take_points();
    if (whole_ = arrivals_.whole(); whole_) finish_colors(renderer);
  }
  if (whole_ && mode_ == Mode::hybrid && !hybrid_) switch_to_clusters(renderer);
}

void WhileLoading::take_points() {
  // Not what comes while these are put in their places: the frame is to be drawn
  std::size_t left = std::min(options_.most_arrivals, arrivals_.ready());
  while (left > 0) {
    const PointArrivals::Batch batch = arrivals_.take(left);
    if (batch.points.empty()) break;
    arriving_->add(batch.points, batch.first_id);
    points_loaded_ += batch.points.size();
    left -= batch.points.size();
  }
  bytes_uploaded_ = arriving_->bytes_uploaded();
}

void WhileLoading::finish_colors(ProgressiveRenderer& renderer) {
  if (points_loaded_ == 0 || whole_->colors == arrivals_.colors()) return;
  const ColorUpload colors(colors_by_id(whole_->points));
  arriving_->recolor(colors, whole_->points);
  renderer.recolor(colors);
  color_bytes_uploaded_ = colors.bytes();
  bytes_uploaded_ += colors.bytes();
}

void WhileLoading::switch_to_clusters(ProgressiveRenderer& renderer) {
  if (!cut_.valid()) {
    const auto policy = options_.cut_at_once ? std::launch::deferred : std::launch::async;
    cut_ = std::async(policy, [whole = whole_] { return cut_cloud(whole->points); });
  }
  if (!options_.cut_at_once && cut_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  hybrid_ = make_hybrid(whole_->points, cut_.get(), options_.method);
  renderer.use(*hybrid_);
  arriving_.reset();
}

}  // namespace stipple
