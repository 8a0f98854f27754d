#include "render/raster/compute_rasterizer.h"

#include <cstddef>

namespace stipple {
namespace {

Program compile_raster(const std::vector<ShaderDefine>& defines) {
  return Program::compute("raster_compute.glsl", defines);
}

Program compile_raster_over_picture(std::vector<ShaderDefine> defines) {
  defines.push_back({"OVER_PICTURE"});
  return compile_raster(defines);
}

void dispatch_points(SourcePrograms& programs, std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    programs.use_for(item);
    if (const auto command = command_of(item)) {
      glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, command->buffer->name());
      glDispatchComputeIndirect(static_cast<GLintptr>(command->offset + offsetof(IndirectCommand, groups_x)));
    } else if (const auto* grid = std::get_if<CarriedGrid>(&item)) {
      dispatch_pixels(grid->previous->size());
    } else {
      dispatch_items(item_capacity(item), kRasterGroupSize);
    }
  }
}

}  // namespace

ComputeRasterizer::ComputeRasterizer(bool splats)
    : depth_("PASS_DEPTH", splats, compile_raster),
      depth_over_picture_("PASS_DEPTH", splats, compile_raster_over_picture),
      claim_("PASS_CLAIM", splats, compile_raster),
      repeat_("PASS_REPEAT", splats, compile_raster) {}

void ComputeRasterizer::rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) {
  constexpr GLbitfield kPixels = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
  constexpr GLbitfield kNotes = GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT;
  target.depth().bind_image(0, GL_READ_WRITE);
  target.ids().bind_image(1, GL_READ_WRITE);
  target.points().bind_image(2, GL_WRITE_ONLY);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);

  dispatch_points(over_picture ? depth_over_picture_ : depth_, items);
  glMemoryBarrier(kPixels);
  notes_.begin();
  dispatch_points(claim_, items);
  glMemoryBarrier(kPixels | kNotes);
  notes_.settle();

  // Costs an empty dispatch an item unless the notes overflowed
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, notes_.buffer().name());
  for (const DrawItem& item : items) {
    repeat_.use_for(item);
    glDispatchComputeIndirect(TieNotes::kRepeatGroupsOffset);
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace stipple
