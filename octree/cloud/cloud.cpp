#include "octree/cloud/cloud.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <cstring>

#include "octree/cloud/columns.h"
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
  cloud.columns = columns_for(cloud.info, attributes, wanted);
  cloud.positions.resize(static_cast<std::size_t>(cloud.info.point_count));

  // Copy each batch to its place; bounds are gathered a thread at a time
  tbb::enumerable_thread_specific<GridBox> bounds;
  source.read(wanted, [&](const PointBatch& batch) {
    const auto first = static_cast<std::size_t>(batch.first);
    std::memcpy(cloud.positions.data() + first, batch.positions.data(), batch.positions.size() * sizeof(glm::ivec3));
    put_columns(batch, cloud.columns);
    GridBox& box = bounds.local();
    for (const glm::ivec3& p : batch.positions) box.extend(p);
    if (arrived) arrived(batch.first, batch.positions.size());
  });
  for (const GridBox& box : bounds) cloud.bounds.extend(box);
}

}  // namespace stipple
