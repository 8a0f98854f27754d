#include "render/store/color_upload.h"

#include <fmt/format.h>

#include <algorithm>

#include "octree/core/error.h"

namespace stipple {
namespace {

// 64 MiB, half of what shaders reach on Mesa's software renderer.
constexpr std::size_t kPieceColors = 1u << 24;

}  // namespace

ColorUpload::ColorUpload(std::span<const std::uint32_t> colors)
    : bytes_(colors.size_bytes()),
      points_(Program::compute("recolor.glsl")),
      picture_(Program::compute("recolor.glsl", {{"PICTURE"}})) {
  for (std::size_t first = 0; first < colors.size(); first += kPieceColors) {
    const std::size_t count = std::min(kPieceColors, colors.size() - first);
    Piece& piece = pieces_.emplace_back(Piece{GpuBuffer(count * sizeof(std::uint32_t)),
                                              static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
    piece.colors.write(0, colors.subspan(first, count));
  }
}

void ColorUpload::paint(const ColoredPoints& points) const {
  const std::size_t size = points.ids->bytes() / sizeof(std::uint32_t);
  points_.use();
  points.points->bind_storage(1);
  points.ids->bind_storage(2);
  glUniform1ui(2, static_cast<GLuint>(size));
  for (const Piece& piece : pieces_) {
    piece.colors.bind_storage(0);
    glUniform1ui(0, piece.first);
    glUniform1ui(1, piece.count);
    dispatch_items(size, 128);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ColorUpload::paint(const FeedbackTarget& picture) const {
  picture_.use();
  picture.points().bind_image(0, GL_READ_WRITE);
  picture.ids().bind_image(1, GL_READ_WRITE);
  for (const Piece& piece : pieces_) {
    piece.colors.bind_storage(0);
    glUniform1ui(0, piece.first);
    glUniform1ui(1, piece.count);
    dispatch_pixels(picture.size());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

Buffer<std::uint32_t> colors_by_id(const PointSet& points) {
  Buffer<std::uint32_t> colors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t id = points.id(i);
    if (id >= points.size())
      throw Error(
          "points that are not numbered from 0 on cannot be given other colours where they lie; those of an octree on "
          "disk are not.");
    colors[id] = points.points[i].rgba;
  }
  return colors;
}

}  // namespace stipple
