#include "render/store/cluster_table.h"

namespace stipple {

void ClusterTable::allocate(std::uint32_t clusters) {
  boxes = GpuBuffer(clusters * sizeof(Row));
  log_pixels = GpuBuffer(clusters * kLevels * sizeof(float));
  first_cells = GpuBuffer(clusters * sizeof(ShardCells));
  last_cells = GpuBuffer(clusters * sizeof(ShardCells));
  capacity = clusters;
}

void ClusterTable::write_rows(std::uint32_t first, std::span<const Row> rows) {
  boxes.write(first * sizeof(Row), rows);
}

void ClusterTable::write_log_pixels(std::uint32_t first, std::span<const float> values) {
  log_pixels.write(first * kLevels * sizeof(float), values);
}

void ClusterTable::write_shards(std::uint32_t first, std::span<const ShardBoxes> values) {
  std::vector<ShardCells> firsts;
  std::vector<ShardCells> lasts;
  for (const ShardBoxes& value : values) {
    firsts.push_back(value.first);
    lasts.push_back(value.last);
  }
  first_cells.write(first * sizeof(ShardCells), std::span<const ShardCells>(firsts));
  last_cells.write(first * sizeof(ShardCells), std::span<const ShardCells>(lasts));
}

}  // namespace stipple
