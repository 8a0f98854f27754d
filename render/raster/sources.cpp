#include "render/raster/sources.h"

#include <algorithm>

namespace stipple {
namespace {

// Notes cost 32 bytes; 65,536 of them cover scans with duplicates in one pixel of fourteen at 1280x720.
constexpr std::size_t kNotes = 65536;
constexpr std::size_t kNoteBytes = 32;
constexpr std::size_t kHeaderBytes = 32;

void bind(const PointRange& range) {
  range.points->bind_storage(0);
  (range.ids ? range.ids : range.points)->bind_storage(1);
  glUniform1ui(0, range.first);
  glUniform1ui(1, range.count);
  glUniform1ui(2, range.first_id - range.first);
  glUniform1i(3, range.ids ? 1 : 0);
}

void bind(const CarriedVertices& vertices) {
  vertices.points->bind_storage(0);
  vertices.ids->bind_storage(1);
  vertices.command->bind_storage(2);
  glUniform1ui(0, 0);
  glUniform1ui(2, 0);
  glUniform1i(3, 1);
}

void bind(const CarriedGrid& grid) {
  grid.previous->points().bind(0);
  grid.previous->carried_ids().bind(1);
}

void bind(const PickedPoints& picked) {
  picked.points->bind_storage(0);
  picked.ids->bind_storage(1);
  picked.places->bind_storage(2);
  glUniform1ui(0, picked.first);
  glUniform1ui(1, picked.count);
  glUniform1i(3, 1);
}

void bind(const CarriedIndices& carried) {
  carried.points->bind_storage(0);
  carried.ids->bind_storage(1);
  carried.places->bind_storage(2);
  carried.commands->bind_storage(4);
  glUniform1ui(0, carried.command);
  glUniform1i(3, 1);
}

}  // namespace

void SourcePrograms::use_for(const DrawItem& item) const {
  const auto* range = std::get_if<PointRange>(&item);
  (range && range->one_pixel && range_of_pixels_ ? *range_of_pixels_ : programs_[item.index()]).use();
  std::visit([](const auto& each) { bind(each); }, item);
}

TieNotes::TieNotes() : buffer_(kHeaderBytes + kNotes * kNoteBytes), settle_(Program::compute("settle_ties.glsl")) {}

void TieNotes::begin() {
  const std::array<std::uint32_t, 8> header{0, 0, 1, 1, 0, 0, 0, 0};
  buffer_.write(0, header.data(), sizeof header);
  buffer_.bind_storage(3);
}

void TieNotes::settle() {
  settle_.use();
  glDispatchCompute(16, 1, 1);
}

std::size_t item_capacity(const DrawItem& item) {
  if (const auto* range = std::get_if<PointRange>(&item)) return range->count;
  if (const auto* picked = std::get_if<PickedPoints>(&item)) return picked->count;
  if (const auto* grid = std::get_if<CarriedGrid>(&item))
    return static_cast<std::size_t>(grid->previous->size().x) * static_cast<std::size_t>(grid->previous->size().y);
  if (const auto* indices = std::get_if<CarriedIndices>(&item)) return indices->places->bytes() / sizeof(std::uint32_t);
  return std::get<CarriedVertices>(item).points->bytes() / sizeof(PackedPoint);
}

}  // namespace stipple
