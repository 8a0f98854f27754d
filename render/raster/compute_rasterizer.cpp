#include "render/raster/compute_rasterizer.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace stipple {
namespace {

constexpr std::size_t kPicksAtOnce = 4;  // of shaders/raster_compute.glsl

// What passes write to pixels, and to keys and notes, later ones see.
constexpr GLbitfield kPixels = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT;

// Compiles a pass with these defines besides its own.
SourcePrograms::Make with(bool keys, std::vector<ShaderDefine> more) {
  if (keys) more.push_back({"KEYS"});
  return [more](std::vector<ShaderDefine> defines) {
    defines.insert(defines.end(), more.begin(), more.end());
    return Program::compute("raster_compute.glsl", defines);
  };
}

void dispatch_points(SourcePrograms& programs, std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    programs.use_for(item);
    if (const auto command = command_of(item)) {
      glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, command->buffer->name());
      glDispatchComputeIndirect(static_cast<GLintptr>(command->offset + offsetof(IndirectCommand, groups_x)));
    } else if (const auto* grid = std::get_if<CarriedGrid>(&item)) {
      dispatch_columns(grid->previous->size());
    } else {
      const bool picks = std::holds_alternative<PickedPoints>(item);
      dispatch_items(item_capacity(item), picks ? kPicksAtOnce * kRasterGroupSize : kRasterGroupSize);
    }
  }
}

// Items whose points the CPU has counted, in batches of `size` points but for the last; and the others.
struct Divided {
  std::vector<std::vector<DrawItem>> batches;
  std::vector<DrawItem> uncounted;
};

template <class Item>
void append_in_batches(std::vector<std::vector<DrawItem>>& batches, std::size_t& room, std::size_t size, Item item) {
  while (item.count > 0) {
    if (room == 0) {
      batches.emplace_back();
      room = size;
    }
    Item part = item;
    part.count = static_cast<std::uint32_t>(std::min<std::size_t>(item.count, room));
    batches.back().push_back(part);
    room -= part.count;
    item.first += part.count;
    item.count -= part.count;
    if constexpr (std::is_same_v<Item, PointRange>) item.first_id += part.count;
  }
}

Divided divided(std::span<const DrawItem> items, std::size_t size) {
  Divided all;
  std::size_t room = 0;
  for (const DrawItem& item : items) {
    if (const auto* range = std::get_if<PointRange>(&item))
      append_in_batches(all.batches, room, size, *range);
    else if (const auto* picked = std::get_if<PickedPoints>(&item))
      append_in_batches(all.batches, room, size, *picked);
    else
      all.uncounted.push_back(item);
  }
  return all;
}

std::size_t points_of(std::span<const DrawItem> items) {
  std::size_t points = 0;
  for (const DrawItem& item : items) points += item_capacity(item);
  return points;
}

}  // namespace

ComputeRasterizer::ComputeRasterizer(bool splats, bool keys, std::size_t batch)
    : batch_(batch),
      depth_("PASS_DEPTH", splats, with(keys, {})),
      depth_over_picture_("PASS_DEPTH", splats, with(keys, {{"OVER_PICTURE"}})),
      collect_("PASS_DEPTH", splats, with(keys, {{"COLLECT"}})),
      collect_over_picture_("PASS_DEPTH", splats, with(keys, {{"COLLECT"}, {"OVER_PICTURE"}})),
      claim_("PASS_CLAIM", splats, with(keys, {})),
      repeat_("PASS_REPEAT", splats, with(keys, {})) {
  if (keys)
    keys_.emplace();
  else
    notes_.emplace();
}

void ComputeRasterizer::draw_batch(std::span<const DrawItem> items, bool over_picture) {
  const std::size_t points = points_of(items);
  if (!contenders_ || contenders_->capacity() < points) contenders_.emplace(std::min(batch_, std::bit_ceil(points)));
  contenders_->begin();
  dispatch_points(over_picture ? collect_over_picture_ : collect_, items);
  contenders_->finish();
  glMemoryBarrier(kPixels);
  const DrawItem vertices = contenders_->vertices();
  dispatch_points(claim_, {&vertices, 1});
  glMemoryBarrier(kPixels);
}

void ComputeRasterizer::settle_ties(std::span<const DrawItem> items) {
  notes_->settle();
  // Costs an empty dispatch an item unless the notes overflowed
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, notes_->buffer().name());
  for (const DrawItem& item : items) {
    repeat_.use_for(item);
    glDispatchComputeIndirect(TieNotes::kRepeatGroupsOffset);
  }
}

void ComputeRasterizer::rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) {
  target.depth().bind_image(0, GL_READ_WRITE);
  target.ids().bind_image(1, GL_READ_WRITE);
  target.points().bind_image(2, GL_WRITE_ONLY);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  if (keys_)
    keys_->begin(target, over_picture);
  else
    notes_->begin();
  glMemoryBarrier(kPixels);

  // Keys say themselves who owns a pixel that was drawn over
  bool over = over_picture && !keys_;
  const Divided all = divided(items, batch_);
  dispatch_points(over ? depth_over_picture_ : depth_, all.uncounted);
  for (const std::vector<DrawItem>& batch : all.batches) {
    draw_batch(batch, over);
    over = !keys_;
  }
  glMemoryBarrier(kPixels);
  dispatch_points(claim_, all.uncounted);
  glMemoryBarrier(kPixels | GL_COMMAND_BARRIER_BIT);
  if (notes_) settle_ties(items);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace stipple
