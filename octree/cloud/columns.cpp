#include "octree/cloud/columns.h"

#include <algorithm>

namespace stipple {

std::vector<Column> columns_for(const SourceInfo& info, const std::vector<std::string>& attributes,
                                std::vector<std::size_t>& indices) {
  std::vector<Column> columns;
  for (const std::string& name : attributes) {
    const auto index = find_attribute(info.schema, name);
    if (!index) continue;
    indices.push_back(*index);
    columns.push_back({info.schema[*index], {}});
    columns.back().resize(static_cast<std::size_t>(info.point_count));
  }
  return columns;
}

void put_columns(const PointBatch& batch, std::vector<Column>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::size_t first = static_cast<std::size_t>(batch.first) * columns[c].attribute.bytes();
    std::ranges::copy(batch.columns[c].bytes, columns[c].bytes.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

std::vector<Column> load_columns(const PointSource& source, const std::vector<std::string>& attributes) {
  std::vector<std::size_t> indices;
  std::vector<Column> columns = columns_for(source.info(), attributes, indices);
  source.read(indices, [&](const PointBatch& batch) { put_columns(batch, columns); });
  return columns;
}

}  // namespace stipple
