#include "render/store/stream_buffer.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstring>
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

PointRange StreamBuffer::stream(const PointSet& points, std::span<const PointSpan> spans) {
  // The section streamed last is free for the CPU again once this fence, set now, is passed
  if (in_use_[section_]) glDeleteSync(in_use_[section_]);
  in_use_[section_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  section_ = (section_ + 1) % kSections;
  constexpr GLuint64 kForever = ~GLuint64{0};
  if (in_use_[section_]) glClientWaitSync(in_use_[section_], GL_SYNC_FLUSH_COMMANDS_BIT, kForever);

  // Where each span goes
  const auto base = static_cast<std::uint32_t>(section_ * section_points_);
  std::vector<std::uint32_t> places(spans.size());
  std::uint32_t end = base;
  for (std::size_t s = 0; s < spans.size(); ++s) {
    places[s] = end;
    end += spans[s].count;
  }

  tbb::parallel_for(std::size_t{0}, spans.size(), [&](std::size_t s) {
    const PointSpan& span = spans[s];
    std::memcpy(mapped_points_ + places[s], points.points.data() + span.first, span.count * sizeof(PackedPoint));
    for (std::uint32_t i = 0; i < span.count; ++i) mapped_ids_[places[s] + i] = points.id(span.first + i);
  });
  return {&points_, &ids_, base, end - base};
}

}  // namespace stipple
