#include "render/store/cluster_cloud.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "octree/core/error.h"
#include "octree/select/density.h"

namespace stipple {
namespace {

static_assert(sizeof(ClusterCloud::ClusterBox) == 32);

// A cluster never spans chunks: larger ones, of trees built with larger clusters, are divided. They are shuffled, so
// that every part is as even a sample as the whole.
constexpr std::uint32_t kLargestCluster = 1u << 16;

struct Part {
  std::uint32_t cluster;
  std::uint32_t first;
  std::uint32_t count;
};

std::vector<Part> parts_of(const Octree& octree) {
  std::vector<Part> parts;
  parts.reserve(octree.clusters.size());
  for (std::uint32_t c = 0; c < octree.clusters.size(); ++c) {
    const Cluster& cluster = octree.clusters[c];
    for (std::uint32_t taken = 0; taken < cluster.count; taken += kLargestCluster)
      parts.push_back({c, cluster.first + taken, std::min(kLargestCluster, cluster.count - taken)});
  }
  return parts;
}

void check_reach(std::size_t clusters) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  const std::uint64_t bytes = std::uint64_t{clusters} * ClusterCloud::kLevels * sizeof(float);
  if (bytes > static_cast<std::uint64_t>(limit))
    throw Error(
        fmt::format("mode hybrid: the table of {} clusters takes {} bytes; this driver's shaders reach {}. Draw in "
                    "mode unstructured or hierarchical.",
                    clusters, bytes, limit));
}

}  // namespace

ClusterCloud::ClusterCloud(const PointSet& points, const Octree& octree) : root_edge_(octree.cube.edge) {
  const std::vector<Part> parts = parts_of(octree);
  check_reach(parts.size());
  clusters_ = static_cast<std::uint32_t>(parts.size());
  std::vector<ClusterBox> boxes(parts.size());
  std::size_t chunk_first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    if (part.first + part.count - chunk_first > kChunkPoints) {
      append_chunk(points, chunk_first, part.first);
      chunk_first = part.first;
    }
    const GridBox& box = octree.clusters[part.cluster].box;
    const auto chunk = static_cast<std::uint32_t>(chunks_.size());
    const auto place = static_cast<std::uint32_t>(part.first - chunk_first);
    boxes[i] = {box.min, chunk << kPlaceBits | place, box.max, part.count};
  }
  if (points.size() > chunk_first) append_chunk(points, chunk_first, points.size());

  std::vector<float> log_pixels(parts.size() * kLevels);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    const BoxCounts& profile = octree.clusters[parts[i].cluster].profile;
    for (int level = 0; level < kLevels; ++level) {
      const double pixels = estimated_pixels(profile, root_edge_, root_edge_ * std::exp2(-level));
      log_pixels[i * kLevels + static_cast<std::size_t>(level)] = static_cast<float>(std::log2(std::max(pixels, 1.0)));
    }
  });
  boxes_ = GpuBuffer(boxes.size() * sizeof(ClusterBox));
  boxes_.write(0, std::span<const ClusterBox>(boxes));
  log_pixels_ = GpuBuffer(log_pixels.size() * sizeof(float));
  log_pixels_.write(0, std::span<const float>(log_pixels));
}

void ClusterCloud::append_chunk(const PointSet& points, std::size_t first, std::size_t end) {
  const std::size_t count = end - first;
  if (chunks_.size() == kMostChunks)
    throw Error(fmt::format("mode hybrid draws at most {} points; there are {}. Draw in mode hierarchical.", first,
                            points.size()));
  Chunk& chunk =
      chunks_.emplace_back(Chunk{GpuBuffer(count * sizeof(PackedPoint)), GpuBuffer(count * sizeof(std::uint32_t))});
  chunk.points.write(0, std::span(points.points).subspan(first, count));
  Buffer<std::uint32_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = points.id(first + i);
  chunk.ids.write(0, std::span<const std::uint32_t>(ids));
}

std::uint64_t ClusterCloud::bytes_for(std::uint64_t points, std::uint64_t clusters) {
  return points * (sizeof(PackedPoint) + sizeof(std::uint32_t)) +
         clusters * (sizeof(ClusterBox) + kLevels * sizeof(float));
}

}  // namespace stipple
