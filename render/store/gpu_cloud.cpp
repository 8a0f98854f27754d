#include "render/store/gpu_cloud.h"

#include <algorithm>
#include <string>

#include "render/gpu/program.h"

namespace stipple {
namespace {

// Chunks a shuffle dispatch writes to. Each takes two storage blocks, the staged points and ids two more: 16 are usual,
// 8 are the least a driver gives.
std::size_t bound_chunks() {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &blocks);
  return blocks >= 16 ? 7 : 3;
}

// Points staged at once: 16 MiB.
constexpr std::size_t kStagedPoints = 1u << 20;

bool is_prime(std::uint32_t n) {
  if (n < 4) return n > 1;
  if (n % 2 == 0 || n % 3 == 0) return false;
  for (std::uint64_t d = 5; d * d <= n; d += 6)
    if (n % d == 0 || n % (d + 2) == 0) return false;
  return true;
}

std::uint32_t permute(std::uint32_t x, std::uint32_t prime) {
  const auto residue = static_cast<std::uint32_t>(std::uint64_t{x} * x % prime);
  return x <= prime / 2 ? residue : prime - residue;
}

// Scatters the staged points to the chunks, some of which are bound at a time.
void scatter(GpuCloud& cloud, std::size_t staged, std::size_t bound) {
  const auto chunks = cloud.chunks();
  for (std::size_t base = 0; base < chunks.size(); base += bound) {
    for (std::size_t k = 0; k < bound; ++k) {
      // Unused bindings repeat the last chunk: no slot leads there
      const GpuCloud::Chunk& chunk = chunks[std::min(base + k, chunks.size() - 1)];
      chunk.points.bind_storage(static_cast<GLuint>(2 + k));
      chunk.ids.bind_storage(static_cast<GLuint>(2 + bound + k));
    }
    glUniform1ui(4, static_cast<GLuint>(base));
    dispatch_items(staged, 128);
  }
}

}  // namespace

GpuCloud::GpuCloud(std::size_t points) : size_(points) {
  for (std::size_t first = 0; first < points; first += kChunkPoints) {
    const std::size_t count = std::min<std::size_t>(kChunkPoints, points - first);
    chunks_.push_back({GpuBuffer(count * sizeof(PackedPoint)), GpuBuffer(count * sizeof(std::uint32_t))});
  }
}

void GpuCloud::append_items(std::size_t first, std::size_t count, std::vector<DrawItem>& items) const {
  while (count > 0) {
    const std::size_t place = first % kChunkPoints;
    const std::size_t here = std::min(count, kChunkPoints - place);
    const Chunk& chunk = chunks_[first / kChunkPoints];
    items.push_back(
        PointRange{&chunk.points, &chunk.ids, static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(here)});
    first += here;
    count -= here;
  }
}

GpuCloud upload_in_order(const PointSet& points) {
  GpuCloud cloud(points.size());
  Buffer<std::uint32_t> counted;
  for (std::size_t c = 0; c < cloud.chunks().size(); ++c) {
    const std::size_t first = c * GpuCloud::kChunkPoints;
    const std::size_t count = std::min<std::size_t>(GpuCloud::kChunkPoints, points.size() - first);
    cloud.chunks()[c].points.write(0, std::span(points.points).subspan(first, count));
    counted.resize(count);
    for (std::size_t i = 0; i < count; ++i) counted[i] = points.id(first + i);
    cloud.chunks()[c].ids.write(0, std::span<const std::uint32_t>(counted));
  }
  return cloud;
}

GpuCloud upload_shuffled(const PointSet& points, std::uint64_t seed) {
  GpuCloud cloud(points.size());
  const auto total = static_cast<std::uint32_t>(points.size());
  const std::uint32_t prime = largest_shuffle_prime(total);
  const std::size_t bound = bound_chunks();
  const Program shuffle = Program::compute(
      "shuffle.glsl",
      {{"CHUNKS", std::to_string(bound)}, {"CHUNK_POINTS", std::to_string(GpuCloud::kChunkPoints) + "u"}});
  GpuBuffer staged_points(kStagedPoints * sizeof(PackedPoint));
  GpuBuffer staged_ids(kStagedPoints * sizeof(std::uint32_t));

  for (std::size_t first = 0; first < points.size(); first += kStagedPoints) {
    const std::size_t count = std::min(kStagedPoints, points.size() - first);
    staged_points.write(0, std::span(points.points).subspan(first, count));
    if (!points.ids.empty()) staged_ids.write(0, std::span(points.ids).subspan(first, count));
    shuffle.use();
    staged_points.bind_storage(0);
    staged_ids.bind_storage(1);
    glUniform1ui(0, static_cast<GLuint>(first));
    glUniform1ui(1, static_cast<GLuint>(count));
    glUniform1ui(2, prime);
    glUniform1ui(3, prime ? static_cast<GLuint>(seed % prime) : 0);
    glUniform1i(5, points.ids.empty() ? 0 : 1);
    scatter(cloud, count, bound);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  return cloud;
}

std::uint32_t largest_shuffle_prime(std::uint32_t n) {
  if (n < 3) return 0;
  // Largest number <= n that is 3 mod 4, then down in fours
  std::uint32_t p = n - (n + 1) % 4;
  while (!is_prime(p)) p -= 4;
  return p;
}

ShuffledSlots::ShuffledSlots(std::uint32_t n, std::uint64_t seed)
    : prime_(largest_shuffle_prime(n)), shift_(prime_ ? static_cast<std::uint32_t>(seed % prime_) : 0) {}

std::uint32_t ShuffledSlots::operator()(std::uint32_t i) const {
  if (i >= prime_) return i;
  const auto shifted = static_cast<std::uint32_t>((std::uint64_t{permute(i, prime_)} + shift_) % prime_);
  return permute(shifted, prime_);
}

}  // namespace stipple
