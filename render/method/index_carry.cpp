#include "render/method/index_carry.h"

#include <fmt/format.h>

#include <string>

#include "octree/core/error.h"

namespace stipple {
namespace {

Program compile_pass(std::vector<ShaderDefine> defines) {
  defines.push_back({"CHUNK_POINTS", std::to_string(GpuCloud::kChunkPoints) + "u"});
  return Program::compute("prepare_indices.glsl", defines);
}

GpuBuffer upload_slots(std::span<const std::uint32_t> slot_of) {
  check_shader_storage(slot_of.size_bytes(), fmt::format("the places of {} points", slot_of.size()),
                       "Use --carry vertex.");
  GpuBuffer buffer(slot_of.size_bytes());
  buffer.write(0, slot_of);
  return buffer;
}

}  // namespace

IndexCarry::IndexCarry(const GpuCloud& cloud, std::span<const std::uint32_t> slot_of)
    : cloud_(cloud),
      own_slots_(upload_slots(slot_of)),
      slot_of_(own_slots_),
      commands_(cloud.chunks().size() * sizeof(IndirectCommand)),
      count_(compile_pass({{"COUNT"}})),
      begin_(compile_pass({{"BEGIN"}})),
      write_(compile_pass({})) {}

IndexCarry::IndexCarry(const GpuCloud& cloud, const GpuBuffer& slot_of)
    : cloud_(cloud),
      slot_of_(slot_of),
      commands_(cloud.chunks().size() * sizeof(IndirectCommand)),
      count_(compile_pass({{"COUNT"}})),
      begin_(compile_pass({{"BEGIN"}})),
      write_(compile_pass({})) {}

void IndexCarry::prepare(const FeedbackTarget& frame) {
  const auto pixels = static_cast<std::size_t>(frame.size().x) * static_cast<std::size_t>(frame.size().y);
  if (places_.bytes() != pixels * sizeof(std::uint32_t)) places_ = GpuBuffer(pixels * sizeof(std::uint32_t));
  commands_.fill(0);
  slot_of_.bind_storage(0);
  places_.bind_storage(1);
  commands_.bind_storage(2);
  frame.carried_ids().bind(1);
  count_.use();
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  begin_.use();
  glUniform1ui(0, static_cast<GLuint>(cloud_.chunks().size()));
  glUniform1ui(1, kRasterGroupSize);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  write_.use();
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void IndexCarry::append_items(const FeedbackTarget& frame, std::vector<DrawItem>& items) {
  prepare(frame);
  for (std::size_t c = 0; c < cloud_.chunks().size(); ++c)
    items.push_back(CarriedIndices{&cloud_.chunks()[c].points, &cloud_.chunks()[c].ids, &places_, &commands_,
                                   static_cast<std::uint32_t>(c)});
}

}  // namespace stipple
