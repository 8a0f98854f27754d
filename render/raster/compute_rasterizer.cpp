#include "render/raster/compute_rasterizer.h"

#include <cstddef>

namespace stipple {
namespace {

Program compile(const std::vector<ShaderDefine>& defines) { return Program::compute("raster_compute.glsl", defines); }

void run_pass(const SourcePrograms& programs, std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    programs.use_for(item);
    if (const auto* vertices = std::get_if<CarriedVertices>(&item)) {
      glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, vertices->command->name());
      glDispatchComputeIndirect(offsetof(CarriedCommand, groups_x));
    } else {
      dispatch_items(item_capacity(item), kRasterGroupSize);
    }
  }
}

}  // namespace

ComputeRasterizer::ComputeRasterizer()
    : depth_("PASS_DEPTH", compile), claim_("PASS_CLAIM", compile), repeat_("PASS_REPEAT", compile) {}

void ComputeRasterizer::draw(FeedbackTarget& target, std::span<const DrawItem> items) {
  constexpr GLbitfield kPixels = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
  constexpr GLbitfield kNotes = GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT;
  target.clear();
  target.depth().bind_image(0, GL_READ_WRITE);
  target.ids().bind_image(1, GL_READ_WRITE);
  target.points().bind_image(2, GL_WRITE_ONLY);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);

  run_pass(depth_, items);
  glMemoryBarrier(kPixels);
  notes_.begin();
  run_pass(claim_, items);
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
