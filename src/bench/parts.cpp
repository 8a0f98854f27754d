#include "src/bench/parts.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <numeric>

#include "octree/build/builder.h"
#include "octree/cloud/cloud.h"
#include "render/frame/propose_views.h"
#include "render/frame/vertex_carry.h"
#include "render/frame/view_block.h"
#include "render/reference/reference.h"
#include "render/store/colorize.h"
#include "render/store/gpu_cloud.h"

namespace stipple {
namespace {

View oblique_view(const PointSet& points, const glm::ivec2& size) {
  const auto cameras = propose_cameras(points, static_cast<double>(size.x) / size.y);
  return make_view(cameras.front().camera, size, near_plane(points.grid));
}

// One value of every batch is looked at: the reader may not be optimised away, nor the looking be what is timed.
void read_through(const PointSource& source, std::span<const std::size_t> attributes) {
  std::atomic<std::uint32_t> seen{0};
  source.read(attributes, [&](const PointBatch& batch) {
    if (!batch.positions.empty()) seen.fetch_add(static_cast<std::uint32_t>(batch.positions.back().x));
  });
}

// Shuffled points on the GPU and half a picture of them: the state in which a progressive frame starts.
class ProgressiveFrame {
 public:
  ProgressiveFrame(const PointSet& points, const View& view, RasterizerKind kind, std::uint32_t budget)
      : rasterizer_(make_rasterizer(kind, false)),
        cloud_(upload_shuffled(points, 0)),
        budget_(std::min<std::size_t>(budget, points.size() / 2)),
        target_(view.size, rasterizer_->depth_storage()),
        previous_(view.size, rasterizer_->depth_storage()),
        vertices_(view.size) {
    uniforms_.set(make_view_block(view, points.grid, 1.0));
    std::vector<DrawItem> half;
    cloud_.append_items(0, points.size() / 2, half);
    rasterizer_->draw(previous_, half);
    vertices_.prepare(previous_);
    glFinish();
  }

  void prepare() {
    vertices_.prepare(previous_);
    glFinish();
  }
  // Reprojects as told and fills the next `budget` points, or none.
  void draw(Carry carry, bool fill) {
    std::vector<DrawItem> items;
    if (fill) cloud_.append_items(cloud_.size() / 2, budget_, items);
    if (carry == Carry::grid) items.push_back(CarriedGrid{&previous_});
    if (carry == Carry::vertices) items.push_back(vertices_.vertices());
    rasterizer_->draw(target_, items);
    glFinish();
  }
  std::size_t budget() const { return budget_; }
  std::uint32_t carried() { return coverage_.count(previous_.ids()); }

 private:
  std::unique_ptr<Rasterizer> rasterizer_;
  GpuCloud cloud_;
  std::size_t budget_;
  ViewUniforms uniforms_;
  FeedbackTarget target_;
  FeedbackTarget previous_;
  VertexCarry vertices_;
  CoverageCounter coverage_;
};

void bench_brute_force(const PointSet& points, const View& view, RasterizerKind kind, const BenchSettings& settings,
                       const TimingSink& sink) {
  const GpuCloud cloud = upload_in_order(points);
  const auto rasterizer = make_rasterizer(kind, false);
  FeedbackTarget target(view.size, rasterizer->depth_storage());
  ViewUniforms uniforms;
  uniforms.set(make_view_block(view, points.grid, 1.0));
  std::vector<DrawItem> all;
  cloud.append_items(0, cloud.size(), all);
  sink(time_part(fmt::format("{}: brute force", name_of(kind)), static_cast<double>(points.size()), "points",
                 settings.repeats, [&] {
                   rasterizer->draw(target, all);
                   glFinish();
                 }));
}

void bench_frame(const PointSet& points, const View& view, RasterizerKind kind, const BenchSettings& settings,
                 const TimingSink& sink) {
  ProgressiveFrame frame(points, view, kind, settings.budget);
  const auto name = [&](const char* part) { return fmt::format("{}: {}", name_of(kind), part); };
  const double carried = frame.carried();
  const auto budget = static_cast<double>(frame.budget());
  sink(time_part(name("reproject, screen grid"), carried, "points", settings.repeats,
                 [&] { frame.draw(Carry::grid, false); }));
  sink(time_part(name("reproject, vertices"), carried, "points", settings.repeats,
                 [&] { frame.draw(Carry::vertices, false); }));
  sink(time_part(name("fill"), budget, "points", settings.repeats, [&] { frame.draw(Carry::none, true); }));
  sink(time_part(name("reproject vertices and fill"), carried + budget, "points", settings.repeats,
                 [&] { frame.draw(Carry::vertices, true); }));
  sink(time_part(name("prepare"), carried, "points", settings.repeats, [&] { frame.prepare(); }));
}

}  // namespace

void bench_reading(const PointSource& source, const BenchSettings& settings, const TimingSink& sink) {
  const SourceInfo& info = source.info();
  const auto points = static_cast<double>(info.point_count);
  const std::string color = choose_color(info.schema, "");
  std::vector<std::size_t> some;
  if (const auto index = find_attribute(info.schema, color)) some.push_back(*index);
  std::vector<std::size_t> all(info.schema.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  sink(time_part(fmt::format("read {}: positions and {}", info.format, color), points, "points", settings.repeats,
                 [&] { read_through(source, some); }));
  sink(time_part(fmt::format("read {}: all {} attributes", info.format, all.size()), points, "points", settings.repeats,
                 [&] { read_through(source, all); }));
  sink(time_part(fmt::format("load {} into memory", info.format), points, "points", settings.repeats,
                 [&] { load_cloud(source, attributes_for_color(color)); }));
}

void bench_processing(const Dataset& dataset, const BenchSettings& settings, const TimingSink& sink) {
  const PointSet& set = dataset.points;
  const auto points = static_cast<double>(set.size());
  sink(time_part("build octree in memory", points, "points", std::min(settings.repeats, 3), [&] {
    build_octree(set.grid, set.bounds, PositionView(std::span<const PackedPoint>(set.points), &PackedPoint::position));
  }));
  const View view = oblique_view(set, settings.size);
  sink(time_part("reference, double precision", points, "points", settings.repeats,
                 [&] { render_reference(set, view); }));
}

void bench_drawing(const Dataset& dataset, const BenchSettings& settings, const TimingSink& sink) {
  const View view = oblique_view(dataset.points, settings.size);
  for (const RasterizerKind kind : {RasterizerKind::points, RasterizerKind::compute}) {
    bench_brute_force(dataset.points, view, kind, settings, sink);
    bench_frame(dataset.points, view, kind, settings, sink);
  }
}

}  // namespace stipple
