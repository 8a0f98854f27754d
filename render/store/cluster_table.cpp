#include "render/store/cluster_table.h"

namespace stipple {

void ClusterTable::allocate(std::uint32_t clusters) {
  boxes = GpuBuffer(clusters * sizeof(Row));
  log_pixels = GpuBuffer(clusters * kLevels * sizeof(float));
  shards = GpuBuffer(clusters * sizeof(ShardBoxes));
  capacity = clusters;
}

void ClusterTable::write_rows(std::uint32_t first, std::span<const Row> rows) {
  boxes.write(first * sizeof(Row), rows);
}

void ClusterTable::write_log_pixels(std::uint32_t first, std::span<const float> values) {
  log_pixels.write(first * kLevels * sizeof(float), values);
}

void ClusterTable::write_shards(std::uint32_t first, std::span<const ShardBoxes> values) {
  shards.write(first * sizeof(ShardBoxes), values);
}

}  // namespace stipple
