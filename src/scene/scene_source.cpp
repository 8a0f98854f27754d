#include "src/scene/scene_source.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/scene/floor.h"

namespace stipple::scene {
namespace {

constexpr std::uint64_t kBatchPoints = 65536;

enum SchemaIndex : std::size_t { kRgb, kIntensity, kClassification };

Schema scene_schema() {
  return {{"rgb", ScalarType::u16, 3}, {"intensity", ScalarType::u16}, {"classification", ScalarType::u8}};
}

// Nearest of 0 ... steps. Added and cut off rather than rounded: libm's rounding mode plays no part.
int quantize(float unit_value, int steps) {
  return static_cast<int>(std::clamp(unit_value, 0.0f, 1.0f) * static_cast<float>(steps) + 0.5f);
}

glm::ivec3 nearest_cell(const glm::dvec3& p) {
  return {floor_of(p.x + 0.5), floor_of(p.y + 0.5), floor_of(p.z + 0.5)};
}

void store(const ScenePoint& point, std::size_t attribute, std::size_t i, Column& column) {
  switch (attribute) {
    case kRgb:
      for (int c = 0; c < 3; ++c)
        column.as<std::uint16_t>()[3 * i + static_cast<std::size_t>(c)] =
            static_cast<std::uint16_t>(quantize(point.colour[c], 255) * 257);
      break;
    case kIntensity:
      column.as<std::uint16_t>()[i] = static_cast<std::uint16_t>(quantize(point.intensity, 65535));
      break;
    case kClassification:
      column.as<std::uint8_t>()[i] = static_cast<std::uint8_t>(point.point_class);
      break;
  }
}

}  // namespace

SceneSource::SceneSource(const std::string& name, std::uint64_t points, std::unique_ptr<const SceneModel> model)
    : model_(std::move(model)) {
  info_.path = name;
  info_.format = "scene";
  info_.encoding = "generated";
  info_.point_count = points;
  info_.grid = model_->grid();
  info_.schema = scene_schema();
  info_.stated_bounds = model_->bounds();
}

void SceneSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  const std::uint64_t batches = (info_.point_count + kBatchPoints - 1) / kBatchPoints;
  tbb::parallel_for(std::uint64_t{0}, batches, [&](std::uint64_t b) {
    // A new batch each time: a consumer that works in parallel itself may come back here on the same thread
    PointBatch batch;
    batch.first = b * kBatchPoints;
    const auto count = static_cast<std::size_t>(std::min(kBatchPoints, info_.point_count - batch.first));
    batch.positions.resize(count);
    for (const std::size_t a : attributes) {
      batch.columns.push_back({info_.schema.at(a), {}});
      batch.columns.back().resize(count);
    }

    for (std::size_t i = 0; i < count; ++i) {
      const ScenePoint point = model_->point(batch.first + i);
      batch.positions[i] = nearest_cell(point.position / info_.grid.scale);
      for (std::size_t c = 0; c < attributes.size(); ++c) store(point, attributes[c], i, batch.columns[c]);
    }
    consume(batch);
  });
}

}  // namespace stipple::scene
