#include "render/store/stream_buffer.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstring>
#include <numeric>
#include <vector>

#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr GLbitfield kMapping = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

void* map(const GpuBuffer& buffer) {
  void* mapped = glMapNamedBufferRange(buffer.name(), 0, static_cast<GLsizeiptr>(buffer.bytes()), kMapping);
  if (!mapped) throw Error(fmt::format("the OpenGL driver cannot map a buffer of {} bytes", buffer.bytes()));
  return mapped;
}

}  // namespace

StreamBuffer::StreamBuffer(std::uint32_t section_points)
    : section_points_(section_points),
      points_(kSections * section_points * sizeof(PackedPoint), kMapping),
      ids_(kSections * section_points * sizeof(std::uint32_t), kMapping),
      mapped_points_(static_cast<PackedPoint*>(map(points_))),
      mapped_ids_(static_cast<std::uint32_t*>(map(ids_))) {}

StreamBuffer::~StreamBuffer() {
  for (const GLsync sync : in_use_)
    if (sync) glDeleteSync(sync);
}

PointRange StreamBuffer::stream(std::span<const PointPiece> pieces) {
  // The section streamed last is free for the CPU again once this fence, set now, is passed
  if (in_use_[section_]) glDeleteSync(in_use_[section_]);
  in_use_[section_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  section_ = (section_ + 1) % kSections;
  constexpr GLuint64 kForever = ~GLuint64{0};
  if (in_use_[section_]) glClientWaitSync(in_use_[section_], GL_SYNC_FLUSH_COMMANDS_BIT, kForever);

  // Where each piece goes
  const auto base = static_cast<std::uint32_t>(section_ * section_points_);
  std::vector<std::uint32_t> places(pieces.size());
  std::uint32_t end = base;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    places[p] = end;
    end += pieces[p].count;
  }

  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    const PointPiece& piece = pieces[p];
    std::memcpy(mapped_points_ + places[p], piece.points, piece.count * sizeof(PackedPoint));
    std::uint32_t* ids = mapped_ids_ + places[p];
    if (piece.ids)
      std::memcpy(ids, piece.ids, piece.count * sizeof(std::uint32_t));
    else
      std::iota(ids, ids + piece.count, piece.first_id);
  });
  return {&points_, &ids_, base, end - base};
}

}  // namespace stipple
