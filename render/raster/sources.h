// What both rasterizers share: binding the points of an item, and settling ties.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/gpu/program.h"
#include "render/raster/rasterizer.h"

namespace stipple {

// One program per kind of item, made from the same shader files with another define (shaders/point_source.glsl) when
// the first of its kind is drawn: few kinds ever are.
class SourcePrograms {
 public:
  using Make = std::function<Program(const std::vector<ShaderDefine>&)>;
  // `make` compiles a variant from its defines. `splats`: points may be larger or smaller than a pixel.
  SourcePrograms(std::string pass, bool splats, Make make)
      : pass_(std::move(pass)), splats_(splats), make_(std::move(make)) {}

  // Uses the program for this item and binds the item's points to it.
  void use_for(const DrawItem& item);

 private:
  Program compile(std::size_t kind, bool splats) const;

  std::string pass_;
  bool splats_;
  Make make_;
  std::array<std::optional<Program>, std::variant_size_v<DrawItem>> programs_;
  std::optional<Program> range_of_pixels_;  // for PointRange::one_pixel
};

// The notes of shaders/ties.glsl.
class TieNotes {
 public:
  TieNotes();
  // Before the claim pass: forgets all notes and binds them.
  void begin();
  // After it: every pixel named in a note shows its winner.
  void settle();
  // Commands that repeat the claim pass, doing nothing unless the notes overflowed: byte offsets in buffer().
  const GpuBuffer& buffer() const { return buffer_; }
  static constexpr std::size_t kRepeatGroupsOffset = 4;
  static constexpr std::size_t kRepeatInstancesOffset = 16;

 private:
  GpuBuffer buffer_;
  Program settle_;
};

// Where the GPU keeps the command that draws an item.
struct CommandPlace {
  const GpuBuffer* buffer = nullptr;  // of IndirectCommands
  std::size_t offset = 0;             // bytes
};
// Nothing for items whose points the CPU has counted.
std::optional<CommandPlace> command_of(const DrawItem& item);

// Upper bound of the points of an item, where the CPU knows one: a vertex for each pixel at most.
std::size_t item_capacity(const DrawItem& item);

}  // namespace stipple
