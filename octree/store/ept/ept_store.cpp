#include "octree/store/ept/ept_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "octree/core/error.h"
#include "octree/store/ept/zstandard.h"
#include "octree/store/json_value.h"
#include "octree/store/node_file.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;
using ept::DataType;

constexpr std::string_view kMetadataName = "ept.json";

std::string folder_of(const std::string& path) {
  return (fs::path(path).filename() == kMetadataName ? fs::path(path).parent_path() : fs::path(path)).string();
}

std::string metadata_path(const std::string& folder) {
  return (fs::path(folder) / kMetadataName).string();
}

std::string_view extension_of(DataType type) {
  if (type == DataType::laszip) return "laz";
  return type == DataType::binary ? "bin" : "zst";
}

std::string encoding_of(const ept::Metadata& metadata) {
  if (metadata.data_type == DataType::laszip) return "laszip";
  return fmt::format("{}, {} bytes a point{}", metadata.data_type == DataType::binary ? "binary" : "zstandard",
                     metadata.rows.bytes, metadata.data_type == DataType::binary ? "" : " unpacked");
}

TreeInfo describe(const ept::Metadata& metadata, const std::string& path) {
  TreeInfo info;
  info.source.path = path;
  info.source.format = "EPT";
  info.source.version = metadata.version;
  info.source.encoding = encoding_of(metadata);
  info.source.point_count = metadata.points;
  info.source.grid = metadata.grid;
  info.source.schema = metadata.rows.schema();
  if (metadata.points > 0)
    info.source.stated_bounds = metadata.conforming.empty() ? metadata.cube : metadata.conforming;
  const glm::dvec3 size = metadata.cube.max - metadata.cube.min;
  info.cube = {metadata.cube.min, std::max({size.x, size.y, size.z})};
  if (metadata.span > 0.0) info.spacing = info.cube.edge / metadata.span;
  info.ranges = metadata.ranges;
  info.node_files = true;
  return info;
}

// Writers pick the cell before they round the point: to the grid, or to a float.
glm::dvec3 cell_margin(const ept::Metadata& metadata, const Grid& grid) {
  glm::dvec3 margin = grid.scale;
  for (int axis = 0; axis < 3; ++axis)
    if (metadata.axes[static_cast<std::size_t>(axis)].type == ScalarType::f32)
      margin[axis] += std::numeric_limits<float>::epsilon() *
                      std::max(std::abs(metadata.cube.min[axis]), std::abs(metadata.cube.max[axis]));
  return margin;
}

std::string points_of(const StoredNode& node) {
  return fmt::format("the {} points of node {}", node.points, ept::key_of(node));
}

}  // namespace

EptStore::EptStore(const std::string& path)
    : folder_(folder_of(path)),
      metadata_(ept::parse_metadata(read_json_file(metadata_path(folder_)), metadata_path(folder_))),
      info_(describe(metadata_, path)) {
  count_read(fs::file_size(metadata_path(folder_)));
  root_piece_ = read_page(StoredNode{});
  if (metadata_.data_type == DataType::laszip) take_las_schema();
  info_.cell_margin = cell_margin(metadata_, info_.source.grid);
}

// The first node with points tells for all; read_las_node() holds the others to it.
void EptStore::take_las_schema() {
  info_.ranges.clear();
  const std::vector<StoredNode> first = uppermost_nodes(*this);
  if (first.empty()) return;
  const SourceInfo las = las_node_info(node_path(first.front()), points_of(first.front()));
  info_.source.encoding = fmt::format("laszip, {} {}, {}", las.format, las.version, las.encoding);
  info_.source.grid = las.grid;
  info_.source.schema = las.schema;
  for (const Attribute& attribute : las.schema) {
    const auto stated = find_attribute(metadata_.rows.schema(), attribute.name);
    info_.ranges.push_back(stated ? metadata_.ranges[*stated] : AttributeRange{});
  }
}

TreeStore::HierarchyPiece EptStore::read_piece(const HierarchyPiece::Continuation&, const StoredNode& parent) const {
  return read_page(parent);
}

TreeStore::HierarchyPiece EptStore::read_page(const StoredNode& first) const {
  const std::string path = (fs::path(folder_) / "ept-hierarchy" / (ept::key_of(first) + ".json")).string();
  const std::string text = read_json_file(path);
  count_read(text.size());
  return ept::parse_page(text, first, path);
}

std::string EptStore::node_path(const StoredNode& node) const {
  return (fs::path(folder_) / "ept-data" / fmt::format("{}.{}", ept::key_of(node), extension_of(metadata_.data_type)))
      .string();
}

StoredNode EptStore::locate(const StoredNode& node) const {
  StoredNode located = node;
  if (node.points == 0) return located;
  const std::string path = node_path(node);
  const InputFile file = open_node_file(path, points_of(node));
  located.byte_size = file.size();
  const auto wrong = [&](const std::string& found) {
    return Error(
        fmt::format("{}: {}, and {} were expected. Copy or download the tree again.", path, found, points_of(node)));
  };
  const std::uint64_t unpacked = node.points * metadata_.rows.bytes;
  if (metadata_.data_type == DataType::laszip) {
    const std::uint64_t points = las_node_info(path, points_of(node)).point_count;
    count_read(std::min<std::uint64_t>(file.size(), kLasHeaderBytes));
    if (points != node.points) throw wrong(fmt::format("the header states {} points", points));
  } else if (metadata_.data_type == DataType::binary) {
    if (file.size() != unpacked)
      throw wrong(fmt::format("the file has {} bytes, which at {} bytes a point is not {}", file.size(),
                              metadata_.rows.bytes, unpacked));
  } else {
    std::array<std::byte, ept::kFrameHeaderBytes> begin{};
    const auto bytes = std::span(begin).first(std::min<std::size_t>(begin.size(), file.size()));
    file.read_at(0, bytes);
    count_read(bytes.size());
    if (ept::unpacked_bytes(bytes).value_or(unpacked) != unpacked)
      throw wrong(fmt::format("the file unpacks to {} bytes, which at {} bytes a point is not {}",
                              *ept::unpacked_bytes(bytes), metadata_.rows.bytes, unpacked));
    if (unpacked > ept::kMaxUnpackedBytes)
      throw wrong(fmt::format("at most {} unpacked bytes are read of one node", ept::kMaxUnpackedBytes));
  }
  return located;
}

Buffer<std::byte> EptStore::read_rows(const StoredNode& node, std::uint64_t offset, std::uint64_t bytes) const {
  const std::string path = node_path(node);
  const InputFile file = open_node_file(path, points_of(node));
  // Its size was right when it was located
  if (offset > file.size() || bytes > file.size() - offset)
    throw file_error(path, file.size(), fmt::format("the file ends here, and {} were expected.", points_of(node)));
  Buffer<std::byte> rows(static_cast<std::size_t>(bytes));
  file.read_at(offset, rows);
  count_read(bytes);
  if (metadata_.data_type == DataType::binary) return rows;
  try {
    return ept::unpack(rows, node.points * metadata_.rows.bytes);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {} were expected in {} bytes, but {}. Copy or download the tree again.", path,
                            points_of(node), bytes, error.what()));
  }
}

void EptStore::decode(const StoredNode& node, std::span<const std::byte> rows, std::span<const std::size_t> attributes,
                      PointBatch& batch) const {
  try {
    ept::decode_positions(rows, metadata_, batch.positions);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. The tree is damaged; copy or download it again.", node_path(node), error.what()));
  }
  decode_columns(rows, metadata_.rows, attributes, batch);
}

void EptStore::read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const {
  if (node.points == 0) return clear_batch(info_.source.schema, attributes, batch);
  if (metadata_.data_type != DataType::laszip)
    return decode(node, read_rows(node, 0, node.byte_size), attributes, batch);
  read_las_node(node_path(node), points_of(node), info_.source.schema, attributes, info_.source.grid, batch);
  count_read(node.byte_size);
}

void EptStore::read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                         std::span<const std::size_t> attributes, PointBatch& batch) const {
  if (!reads_parts()) return TreeStore::read_part(node, first, count, attributes, batch);
  const std::uint64_t row = metadata_.rows.bytes;
  decode(node, read_rows(node, first * row, count * row), attributes, batch);
}

bool is_ept(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(metadata_path(folder_of(path)), ignored);
}

}  // namespace stipple
