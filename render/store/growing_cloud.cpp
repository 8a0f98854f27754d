#include "render/store/growing_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "octree/core/error.h"
#include "render/store/insertion.h"

namespace stipple {
namespace {

// Points inserted at once: the table in which the CPU looks up slots stays in its cache.
constexpr std::uint32_t kInserted = 1u << 16;

// Chunks that a dispatch moves points between. Each takes two storage blocks, and there are four more: 16 are usual, 8
// are the least a driver gives. No more than there are: software renderers go through all cases of a switch.
std::size_t chunks_for_insertion(const GpuCloud& cloud) {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &blocks);
  return std::clamp<std::size_t>(cloud.chunks().size(), 1, blocks >= 16 ? 6 : 2);
}

Program compile_insertion(std::size_t bound, std::vector<ShaderDefine> defines) {
  defines.push_back({"CHUNKS", std::to_string(bound)});
  defines.push_back({"CHUNK_POINTS", std::to_string(GpuCloud::kChunkPoints) + "u"});
  return Program::compute("insert.glsl", defines);
}

GpuBuffer room_for_slots(std::size_t points) {
  const std::size_t bytes = points * sizeof(std::uint32_t);
  check_shader_storage(bytes, fmt::format("the places of {} points", points), "Use --carry vertex.");
  return GpuBuffer(bytes);
}

}  // namespace

GrowingCloud::GrowingCloud(std::size_t total, ArrivalOrder order, std::uint64_t seed, bool keep_slots)
    : cloud_(total), random_(seed), keep_slots_(keep_slots) {
  if (order == ArrivalOrder::permuted) {
    shuffler_.emplace(total, seed);
    return;
  }
  bound_ = chunks_for_insertion(cloud_);
  gather_ = compile_insertion(bound_, {{"GATHER"}});
  put_ = compile_insertion(bound_, {});
  // As many points may be displaced as are inserted
  staged_points_ = GpuBuffer(2 * kInserted * sizeof(PackedPoint));
  staged_ids_ = GpuBuffer(2 * kInserted * sizeof(std::uint32_t));
  slots_ = GpuBuffer(3 * kInserted * sizeof(std::uint32_t));
  slot_of_ = keep_slots ? room_for_slots(total) : GpuBuffer(sizeof(std::uint32_t));
  slot_of_.fill(0);
}

void GrowingCloud::add(std::span<const PackedPoint> points, std::uint32_t first_id) {
  if (points.empty()) return;
  if (shuffler_) {
    if (points_ == 0) fill_with(points.front(), first_id);
    shuffler_->put(cloud_, first_id, points);
    points_ += points.size();
    bytes_uploaded_ += points.size_bytes();
    return;
  }
  for (std::size_t first = 0; first < points.size(); first += kInserted)
    insert(points.subspan(first, std::min<std::size_t>(kInserted, points.size() - first)),
           first_id + static_cast<std::uint32_t>(first));
}

// A point drawn again in its place changes nothing.
void GrowingCloud::fill_with(const PackedPoint& point, std::uint32_t id) {
  for (GpuCloud::Chunk& chunk : cloud_.chunks()) {
    chunk.points.fill(std::array<std::int32_t, 4>{point.position.x, point.position.y, point.position.z,
                                                  static_cast<std::int32_t>(point.rgba)});
    chunk.ids.fill(id);
  }
}

void GrowingCloud::insert(std::span<const PackedPoint> points, std::uint32_t first_id) {
  const auto count = static_cast<std::uint32_t>(points.size());
  const Insertion insertion = plan_insertion(static_cast<std::uint32_t>(points_), count, random_);
  const auto displaced = static_cast<std::uint32_t>(insertion.displaced.size());
  std::vector<std::uint32_t> ids(count);
  std::iota(ids.begin(), ids.end(), first_id);
  staged_points_.write(0, points);
  staged_ids_.write(0, std::span<const std::uint32_t>(ids));
  slots_.write(0, std::span<const std::uint32_t>(insertion.slots));
  slots_.write(insertion.slots.size() * sizeof(std::uint32_t), std::span<const std::uint32_t>(insertion.displaced));
  points_ += count;
  bytes_uploaded_ += points.size_bytes() + sizeof(std::uint32_t) * (ids.size() + insertion.slots.size() + displaced);

  staged_points_.bind_storage(0);
  staged_ids_.bind_storage(1);
  slots_.bind_storage(2);
  slot_of_.bind_storage(3);
  if (displaced > 0) move_chunk_by_chunk(gather_, count + displaced, count, displaced);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  move_chunk_by_chunk(put_, 0, 0, count + displaced);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

// Slots beyond the points that there are now are in no chunk that is bound.
void GrowingCloud::move_chunk_by_chunk(const Program& program, std::uint32_t first_slot, std::uint32_t first,
                                       std::uint32_t count) const {
  program.use();
  glUniform1ui(0, first_slot);
  glUniform1ui(1, first);
  glUniform1ui(2, count);
  glUniform1i(4, keep_slots_ ? 1 : 0);
  const std::size_t taken = (points_ + GpuCloud::kChunkPoints - 1) / GpuCloud::kChunkPoints;
  for (std::size_t base = 0; base < taken; base += bound_) {
    bind_chunks(base);
    glUniform1ui(3, static_cast<GLuint>(base));
    dispatch_items(count, 128);
  }
}

void GrowingCloud::bind_chunks(std::size_t first) const {
  const auto chunks = cloud_.chunks();
  for (std::size_t k = 0; k < bound_; ++k) {
    // Unused bindings repeat the last chunk: no slot leads there
    const GpuCloud::Chunk& chunk = chunks[std::min(first + k, chunks.size() - 1)];
    chunk.points.bind_storage(static_cast<GLuint>(4 + k));
    chunk.ids.bind_storage(static_cast<GLuint>(4 + bound_ + k));
  }
}

}  // namespace stipple
