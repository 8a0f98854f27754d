#include "render/reference/reference.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "octree/core/error.h"

namespace stipple {
namespace {

// Points projected at once: long enough to overlap the cache misses of the depth test, short enough to stay in L1.
constexpr std::size_t kBatch = 256;

// Depths are kept as the bits of a double: as all are above zero, bits sort like depths, and zero is free for the lock.
constexpr std::uint64_t kLocked = 0;
constexpr std::uint64_t kEmpty = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());

// The nearest point so far. Whoever lowers `depth` holds it at kLocked while it changes the other two, so that all
// threads can share one image: most points are farther than what is there and only read it.
struct alignas(16) Pixel {
  std::atomic<std::uint64_t> depth{kEmpty};
  std::uint32_t id = kNoPoint;
  std::uint32_t index = 0;  // into the point set
};

void put(Pixel& pixel, std::uint64_t depth, std::uint32_t id, std::uint32_t index) {
  std::uint64_t seen = pixel.depth.load(std::memory_order_relaxed);
  do {
    while (seen == kLocked) seen = pixel.depth.load(std::memory_order_relaxed);
    if (depth > seen) return;
  } while (!pixel.depth.compare_exchange_weak(seen, kLocked, std::memory_order_acquire, std::memory_order_relaxed));
  if (depth < seen || id < pixel.id) {
    pixel.id = id;
    pixel.index = index;
  }
  pixel.depth.store(depth, std::memory_order_release);
}

// Depth and place in pixels of a batch of points; see View.
struct Projected {
  std::array<double, kBatch> depth;
  std::array<double, kBatch> x;
  std::array<double, kBatch> y;
};

class Projection {
 public:
  Projection(const View& view, const Grid& grid)
      : view_(view),
        scale_(grid.scale),
        eye_grid_(grid.grid_from_world(view.eye)),
        half_size_(glm::dvec2(view.size) * 0.5) {}

  void project(const PackedPoint* points, std::size_t count, Projected& out) const {
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 r = (glm::dvec3(points[i].position) - eye_grid_) * scale_;
      const double depth = glm::dot(view_.forward, r);
      out.depth[i] = depth;
      out.x[i] = half_size_.x * (1.0 + glm::dot(view_.right, r) * view_.cot_x / depth);
      out.y[i] = half_size_.y * (1.0 - glm::dot(view_.up, r) * view_.cot_y / depth);
    }
  }

 private:
  View view_;
  glm::dvec3 scale_;
  glm::dvec3 eye_grid_;
  glm::dvec2 half_size_;
};

// The pixels i whose centre i + 0.5 lies in (center - size / 2, center + size / 2], cut to [0, limit).
struct Span {
  int first;
  int last;  // inclusive
};

Span covered(double center, double size, int limit) {
  const double first = std::floor(center - 0.5 * (size + 1.0)) + 1.0;
  const double last = std::floor(center + 0.5 * (size - 1.0));
  return {static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, limit - 1.0))};
}

class Canvas {
 public:
  explicit Canvas(const glm::ivec2& size)
      : size_(size), pixels_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {}

  const Pixel& operator[](std::size_t i) const { return pixels_[i]; }

  // Draws the point whose centre lies at x, y, inside the image, as a square.
  void draw_square(double x, double y, double edge, double depth, std::uint32_t id, std::uint32_t index) {
    const auto bits = std::bit_cast<std::uint64_t>(depth);
    if (edge == 1.0) {
      put(at(static_cast<int>(x), static_cast<int>(y)), bits, id, index);
      return;
    }
    const Span columns = covered(x, edge, size_.x);
    const Span rows = covered(y, edge, size_.y);
    for (int row = rows.first; row <= rows.last; ++row)
      for (int column = columns.first; column <= columns.last; ++column) put(at(column, row), bits, id, index);
  }

  // The same as a disc, and the pixel that x, y is in.
  void draw_splat(double x, double y, double diameter, double depth, std::uint32_t id, std::uint32_t index) {
    const auto bits = std::bit_cast<std::uint64_t>(depth);
    put(at(static_cast<int>(x), static_cast<int>(y)), bits, id, index);
    const Span columns = covered(x, diameter, size_.x);
    const Span rows = covered(y, diameter, size_.y);
    for (int row = rows.first; row <= rows.last; ++row)
      for (int column = columns.first; column <= columns.last; ++column)
        if (std::hypot(column + 0.5 - x, row + 0.5 - y) <= 0.5 * diameter) put(at(column, row), bits, id, index);
  }

 private:
  Pixel& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x)];
  }

  glm::ivec2 size_;
  std::vector<Pixel> pixels_;
};

void draw_range(const PointSet& set, const View& view, const Projection& projection, const PointSize& point_size,
                std::size_t first, std::size_t end, Canvas& canvas) {
  const double splat_at_one = point_size.splat_at_one(view);
  const double width = view.size.x;
  const double height = view.size.y;
  Projected batch;
  for (; first < end; first += kBatch) {
    const std::size_t count = std::min(kBatch, end - first);
    projection.project(set.points.data() + first, count, batch);
    for (std::size_t i = 0; i < count; ++i) {
      if (set.points[first + i].rgba >> 24 == 0) continue;
      const double x = batch.x[i];
      const double y = batch.y[i];
      const double depth = batch.depth[i];
      if (!(depth > view.near && x >= 0.0 && x < width && y >= 0.0 && y < height)) continue;
      const std::uint32_t id = set.id(first + i);
      const auto index = static_cast<std::uint32_t>(first + i);
      const double splat = splat_at_one / depth;
      if (splat > point_size.pixels)
        canvas.draw_splat(x, y, std::min(splat, PointSize::kLargestSplat), depth, id, index);
      else
        canvas.draw_square(x, y, point_size.pixels, depth, id, index);
    }
  }
}

FrameData resolve(const PointSet& set, const Canvas& canvas, const glm::ivec2& size) {
  FrameData frame = empty_frame(size);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, frame.pixels(), 1 << 14), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Pixel& pixel = canvas[i];
      const std::uint64_t depth = pixel.depth.load(std::memory_order_relaxed);
      if (depth == kEmpty) continue;
      frame.ids[i] = pixel.id;
      frame.rgba[i] = set.points[pixel.index].rgba;
      frame.depth[i] = static_cast<float>(std::bit_cast<double>(depth));
      frame.positions[i] = set.points[pixel.index].position;
    }
  });
  return frame;
}

}  // namespace

FrameData render_reference(const PointSet& points, const View& view, const PointSize& point_size) {
  if (!(point_size.pixels > 0.0 && std::isfinite(point_size.pixels)))
    throw UsageError(fmt::format("point size {}: must be above 0 pixels", point_size.pixels));
  if (!(point_size.world >= 0.0 && std::isfinite(point_size.world)))
    throw UsageError(fmt::format("splat size {}: must be 0 or above", point_size.world));
  const Projection projection(view, points.grid);
  Canvas canvas(view.size);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1 << 16), [&](const auto& range) {
    draw_range(points, view, projection, point_size, range.begin(), range.end(), canvas);
  });
  return resolve(points, canvas, view.size);
}

}  // namespace stipple
