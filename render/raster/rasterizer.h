// Points to pixels. Two ways to do it, one result: nearest point, lowest id.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"

namespace stipple {

// Consecutive points of a buffer of PackedPoint.
struct PointRange {
  const GpuBuffer* points = nullptr;
  const GpuBuffer* ids = nullptr;  // uint32 a point; null: point i has id first_id + i - first
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t first_id = 0;
  bool one_pixel =
      false;  // each covers the pixel it falls into and no other, certainly: these are drawn with less work
};

// Vertices collected on the GPU from the last frame; how many, only the GPU knows.
struct CarriedVertices {
  const GpuBuffer* points = nullptr;
  const GpuBuffer* ids = nullptr;
  const GpuBuffer* command = nullptr;  // IndirectCommand of shaders/packing.glsl
};

// The pixels of the last frame, each a point.
struct CarriedGrid {
  const FeedbackTarget* previous = nullptr;
};

// Points of a buffer, picked by their places in it.
struct PickedPoints {
  const GpuBuffer* points = nullptr;
  const GpuBuffer* ids = nullptr;     // uint32 a point
  const GpuBuffer* places = nullptr;  // uint32
  std::uint32_t first = 0;            // of the places
  std::uint32_t count = 0;
};

// Points of a buffer, whose places in it were collected on the GPU from the last frame; how many, only the GPU knows.
struct CarriedIndices {
  const GpuBuffer* points = nullptr;
  const GpuBuffer* ids = nullptr;       // uint32 a point
  const GpuBuffer* places = nullptr;    // uint32; as many as the picture has pixels
  const GpuBuffer* commands = nullptr;  // IndirectCommands, of which this item's is
  std::uint32_t command = 0;            // number
};

// Consecutive points of the first `size` of a buffer, around their end to their beginning; where they begin and how
// many they are, only the GPU knows.
struct SteeredRange {
  const GpuBuffer* points = nullptr;
  const GpuBuffer* ids = nullptr;       // uint32 a point
  const GpuBuffer* commands = nullptr;  // IndirectCommands, of which this item's is
  std::uint32_t command = 0;            // number
  std::uint32_t size = 0;
};

using DrawItem = std::variant<PointRange, CarriedVertices, CarriedGrid, PickedPoints, CarriedIndices, SteeredRange>;

// Layout of IndirectCommand in shaders/packing.glsl.
struct IndirectCommand {
  std::uint32_t count, instance_count, first, base_instance;  // glDrawArraysIndirect
  std::uint32_t groups_x, groups_y, groups_z;                 // glDispatchComputeIndirect
  std::uint32_t begin;
};

enum class RasterizerKind { points, compute };

class Rasterizer {
 public:
  virtual ~Rasterizer() = default;

  virtual DepthStorage depth_storage() const = 0;
  // The least and the largest size of a point it draws, in pixels.
  virtual glm::dvec2 point_sizes() const = 0;
  // How far from its place it may draw a point, in pixels, on each axis.
  virtual double snapping() const { return 0.0; }

  // Clears the target and draws all items into it, in any order: among the points of a pixel the nearest wins, equal
  // depths go to the lowest id. The view block must be bound (ViewUniforms::set). Items must not read `target`.
  void draw(FeedbackTarget& target, std::span<const DrawItem> items) {
    target.clear();
    rasterize(target, items, false);
  }
  // The same without clearing: the target shows points already, drawn with the same view block.
  void add(FeedbackTarget& target, std::span<const DrawItem> items) { rasterize(target, items, true); }

 private:
  virtual void rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) = 0;
};

// `splats`: points may be larger or smaller than a pixel (PointSize::varies()).
std::unique_ptr<Rasterizer> make_rasterizer(RasterizerKind kind, bool splats);

// "points", "compute".
std::string_view name_of(RasterizerKind kind);
std::optional<RasterizerKind> rasterizer_named(std::string_view name);

// Invocations of a work group of shaders/raster_compute.glsl.
inline constexpr std::size_t kRasterGroupSize = 128;

}  // namespace stipple
