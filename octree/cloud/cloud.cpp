#include "octree/cloud/cloud.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <cstring>

#include "octree/core/error.h"

namespace stipple {

const Column* Cloud::find(std::string_view name) const {
  for (const Column& column : columns)
    if (column.attribute.name == name) return &column;
  return nullptr;
}

Cloud load_cloud(const PointSource& source, const std::vector<std::string>& attributes) {
  Cloud cloud;
  load_cloud(source, attributes, cloud, {});
  return cloud;
}

void load_cloud(const PointSource& source, const std::vector<std::string>& attributes, Cloud& cloud,
                const PointsArrived& arrived) {
  cloud = {};
  cloud.info = source.info();
  // The largest two values of an id mean "no point" somewhere on the GPU.
  constexpr std::uint64_t kMaxPoints = 0xFFFFFFFEull;
  if (cloud.info.point_count > kMaxPoints)
    throw Error(fmt::format("{}: has {} points; at most {} fit into one cloud in memory. Split the file.",
                            cloud.info.path, cloud.info.point_count, kMaxPoints));

  std::vector<std::size_t> wanted;
  for (const std::string& name : attributes) {
    const auto index = find_attribute(cloud.info.schema, name);
    if (!index) continue;
    wanted.push_back(*index);
    cloud.columns.push_back({cloud.info.schema[*index], {}});
  }

  const auto count = static_cast<std::size_t>(cloud.info.point_count);
  cloud.positions.resize(count);
  for (Column& column : cloud.columns) column.resize(count);

  // Copy each batch to its place; bounds are gathered a thread at a time
  tbb::enumerable_thread_specific<GridBox> bounds;
  source.read(wanted, [&](const PointBatch& batch) {
    const auto first = static_cast<std::size_t>(batch.first);
    std::memcpy(cloud.positions.data() + first, batch.positions.data(), batch.positions.size() * sizeof(glm::ivec3));
    for (std::size_t c = 0; c < cloud.columns.size(); ++c) {
      const std::size_t stride = cloud.columns[c].attribute.bytes();
      std::memcpy(cloud.columns[c].bytes.data() + first * stride, batch.columns[c].bytes.data(),
                  batch.columns[c].bytes.size());
    }
    GridBox& box = bounds.local();
    for (const glm::ivec3& p : batch.positions) box.extend(p);
    if (arrived) arrived(batch.first, batch.positions.size());
  });
  for (const GridBox& box : bounds) cloud.bounds.extend(box);
}

}  // namespace stipple
