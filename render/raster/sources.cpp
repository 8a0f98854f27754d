#include "render/raster/sources.h"

#include <algorithm>

namespace stipple {
namespace {

// Notes cost 32 bytes; 65,536 of them cover scans with duplicates in one pixel of fourteen at 1280x720.
constexpr std::size_t kNotes = 65536;
constexpr std::size_t kNoteBytes = 32;
constexpr std::size_t kHeaderBytes = 32;

// Units 0 and 1 are the last frame's.
void bind_points(const GpuBuffer& points) {
  points.bind_texels(4, GL_RGBA32I);
}
void bind_ids(const GpuBuffer& ids) {
  ids.bind_texels(5, GL_R32UI);
}
void bind_places(const GpuBuffer& places) {
  places.bind_texels(6, GL_R32UI);
}

void bind(const PointRange& range) {
  bind_points(*range.points);
  if (range.ids) bind_ids(*range.ids);
  glUniform1ui(0, range.first);
  glUniform1ui(1, range.count);
  glUniform1ui(2, range.first_id - range.first);
  glUniform1i(3, range.ids ? 1 : 0);
}

void bind(const CarriedVertices& vertices) {
  bind_points(*vertices.points);
  bind_ids(*vertices.ids);
  vertices.command->bind_storage(2);
  glUniform1ui(0, 0);
  glUniform1ui(2, 0);
  glUniform1i(3, 1);
}

void bind(const CarriedGrid& grid) {
  grid.previous->points().bind(0);
  grid.previous->ids().bind(1);
}

void bind(const PickedPoints& picked) {
  bind_points(*picked.points);
  bind_ids(*picked.ids);
  bind_places(*picked.places);
  glUniform1ui(0, picked.first);
  glUniform1ui(1, picked.count);
  glUniform1i(3, 1);
}

void bind(const CarriedIndices& carried) {
  bind_points(*carried.points);
  bind_ids(*carried.ids);
  bind_places(*carried.places);
  carried.commands->bind_storage(4);
  glUniform1ui(0, carried.command);
  glUniform1i(3, 1);
}

void bind(const SteeredRange& range) {
  bind_points(*range.points);
  bind_ids(*range.ids);
  range.commands->bind_storage(4);
  glUniform1ui(0, range.command);
  glUniform1ui(1, range.size);
  glUniform1i(3, 1);
}

}  // namespace

Program SourcePrograms::compile(std::size_t kind, bool splats) const {
  // In the order of DrawItem
  constexpr std::array<const char*, std::variant_size_v<DrawItem>> kSources{
      "SOURCE_RANGE", "SOURCE_VERTICES", "SOURCE_GRID", "SOURCE_PICKS", "SOURCE_INDICES", "SOURCE_STEERED"};
  std::vector<ShaderDefine> defines{{kSources[kind]}, {pass_}};
  if (splats) defines.push_back({"SPLATS"});
  return make_(defines);
}

void SourcePrograms::use_for(const DrawItem& item) {
  const auto* range = std::get_if<PointRange>(&item);
  const bool of_pixels = splats_ && range && range->one_pixel;
  std::optional<Program>& program = of_pixels ? range_of_pixels_ : programs_[item.index()];
  if (!program) program.emplace(compile(item.index(), splats_ && !of_pixels));
  program->use();
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

std::optional<CommandPlace> command_of(const DrawItem& item) {
  if (const auto* vertices = std::get_if<CarriedVertices>(&item)) return CommandPlace{vertices->command, 0};
  if (const auto* indices = std::get_if<CarriedIndices>(&item))
    return CommandPlace{indices->commands, indices->command * sizeof(IndirectCommand)};
  if (const auto* range = std::get_if<SteeredRange>(&item))
    return CommandPlace{range->commands, range->command * sizeof(IndirectCommand)};
  return std::nullopt;
}

std::size_t item_capacity(const DrawItem& item) {
  if (const auto* range = std::get_if<PointRange>(&item)) return range->count;
  if (const auto* picked = std::get_if<PickedPoints>(&item)) return picked->count;
  if (const auto* grid = std::get_if<CarriedGrid>(&item))
    return static_cast<std::size_t>(grid->previous->size().x) * static_cast<std::size_t>(grid->previous->size().y);
  if (const auto* steered = std::get_if<SteeredRange>(&item)) return steered->size;
  if (const auto* indices = std::get_if<CarriedIndices>(&item)) return indices->places->bytes() / sizeof(std::uint32_t);
  return std::get<CarriedVertices>(item).points->bytes() / sizeof(PackedPoint);
}

}  // namespace stipple
