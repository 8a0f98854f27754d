// A whole cloud on the GPU, spread over buffers that any driver can address.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/frame/point_set.h"
#include "render/gpu/program.h"
#include "render/raster/rasterizer.h"
#include "render/store/color_upload.h"

namespace stipple {

class GpuCloud {
 public:
  // Points a buffer: 64 MiB, half of what shaders reach on Mesa's software renderer.
  static constexpr std::uint32_t kChunkPoints = 1u << 22;

  struct Chunk {
    GpuBuffer points;  // PackedPoint
    GpuBuffer ids;     // uint32
  };

  // Room for `points` points, contents undefined. Throws Error when memory is refused.
  explicit GpuCloud(std::size_t points);

  std::size_t size() const { return size_; }
  std::span<Chunk> chunks() { return chunks_; }
  std::span<const Chunk> chunks() const { return chunks_; }

  // Appends the items that draw slots [first, first + count): one a chunk they touch. `one_pixel`: see PointRange.
  void append_items(std::size_t first, std::size_t count, std::vector<DrawItem>& items, bool one_pixel = false) const;

 private:
  std::size_t size_;
  std::vector<Chunk> chunks_;
};

// What new colours may be painted on.
std::vector<ColoredPoints> colored_points(const GpuCloud& cloud);

// Slot i holds point i.
GpuCloud upload_in_order(const PointSet& points);

// Puts points into slots permute(i), the permutation computed on the GPU: S19's prime-permutation shuffle with P the
// largest prime <= total with P = 3 mod 4, applied twice, the seed added in between. Equal seeds give equal orders;
// slots from P on hold the points from P on.
class Shuffler {
 public:
  // For clouds of `total` points.
  Shuffler(std::size_t total, std::uint64_t seed);

  // Points first, first + 1, ...; without `ids` these are their ids.
  void put(GpuCloud& cloud, std::size_t first, std::span<const PackedPoint> points,
           std::span<const std::uint32_t> ids = {});

 private:
  void scatter(GpuCloud& cloud, std::size_t staged) const;

  std::uint32_t prime_;  // 0: no shuffle
  std::uint32_t shift_;
  std::size_t bound_;  // chunks at a time
  Program program_;
  GpuBuffer staged_points_;
  GpuBuffer staged_ids_;
};

// Slot permute(i) holds point i.
GpuCloud upload_shuffled(const PointSet& points, std::uint64_t seed);

// The largest prime p <= n with p = 3 mod 4, or 0 when n < 3.
std::uint32_t largest_shuffle_prime(std::uint32_t n);

// Where upload_shuffled puts point i of n, on the CPU.
class ShuffledSlots {
 public:
  ShuffledSlots(std::uint32_t n, std::uint64_t seed);
  std::uint32_t operator()(std::uint32_t i) const;

 private:
  std::uint32_t prime_;
  std::uint32_t shift_;
};
inline std::uint32_t shuffled_slot(std::uint32_t i, std::uint32_t n, std::uint64_t seed) {
  return ShuffledSlots(n, seed)(i);
}

}  // namespace stipple
