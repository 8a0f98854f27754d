#include "octree/store/potree1/potree1_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "octree/core/error.h"
#include "octree/store/json_value.h"
#include "octree/store/node_file.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;
using potree1::Encoding;

constexpr std::string_view kMetadataName = "cloud.js";
// 13 million nodes in one piece; converters put a few thousand into one.
constexpr std::uint64_t kMaxPieceBytes = std::uint64_t{64} << 20;

std::string folder_of(const std::string& path) {
  return (fs::path(path).filename() == kMetadataName ? fs::path(path).parent_path() : fs::path(path)).string();
}

std::string metadata_path(const std::string& folder) {
  return (fs::path(folder) / kMetadataName).string();
}

TreeInfo describe(const potree1::Metadata& metadata, const std::string& path) {
  TreeInfo info;
  info.source.path = path;
  info.source.format = "Potree";
  info.source.version = fmt::format("1.{}", metadata.version_minor);
  info.source.encoding = fmt::format("records of {} bytes a point", metadata.rows.bytes);
  info.source.point_count = metadata.points.value_or(0);
  info.source.schema = metadata.rows.schema();
  const glm::dvec3 size = metadata.cube.max - metadata.cube.min;
  info.cube = {metadata.cube.min, std::max({size.x, size.y, size.z})};
  info.spacing = metadata.spacing;
  info.ranges.resize(info.source.schema.size());
  info.states_points = metadata.points.has_value();
  info.node_files = true;
  return info;
}

std::string points_of(const StoredNode& node) {
  return fmt::format("the points of node {}", name_of(node));
}

}  // namespace

Potree1Store::Potree1Store(const std::string& path)
    : folder_(folder_of(path)),
      metadata_(potree1::parse_metadata(read_json_file(metadata_path(folder_)), metadata_path(folder_))),
      info_(describe(metadata_, path)) {
  count_read(fs::file_size(metadata_path(folder_)));
  if (metadata_.step_size > 0) metadata_.hierarchy = read_hrc(StoredNode{});
  take_grid(metadata_.scale);
  if (metadata_.encoding != Encoding::bin) take_las_schema();
  // Converters cut off what is below a step of the node's grid, and that of the tree rounds
  info_.cell_margin = glm::dvec3(metadata_.scale) + info_.source.grid.scale;
  if (!metadata_.points)
    for (const StoredNode& node : locate_all(*this, read_whole_hierarchy(*this)))
      info_.source.point_count += node.points;
  if (info_.source.point_count > 0)
    info_.source.stated_bounds = metadata_.tight.empty() ? metadata_.cube : metadata_.tight;
}

void Potree1Store::take_grid(double scale) {
  const int depth = potree1::depth_for_grid(metadata_.hierarchy, metadata_.cube, scale);
  info_.source.grid = potree1::grid_of(metadata_.cube, scale, depth);
}

// The first node with points tells for all; read_las_node() holds the others to it.
void Potree1Store::take_las_schema() {
  const std::vector<StoredNode> first = uppermost_nodes(*this);
  if (first.empty()) return;
  const SourceInfo las = las_node_info(node_path(first.front()), points_of(first.front()));
  info_.source.encoding = fmt::format("{} {}, {}", las.format, las.version, las.encoding);
  info_.source.schema = las.schema;
  info_.ranges.resize(las.schema.size());
  // Some converters give every node an offset of its own, its corner; others one to all
  const WorldBox cell = cell_of(info_.cube, first.front());
  const glm::dvec3 from_corner = glm::abs(las.grid.offset - cell.min);
  if (glm::any(glm::greaterThan(from_corner, 0.5 * las.grid.scale)))
    info_.source.grid = las.grid;
  else
    take_grid(std::min({las.grid.scale.x, las.grid.scale.y, las.grid.scale.z}));
  metadata_.scale = std::max({metadata_.scale, las.grid.scale.x, las.grid.scale.y, las.grid.scale.z});
}

TreeStore::HierarchyPiece Potree1Store::read_piece(const HierarchyPiece::Continuation&,
                                                   const StoredNode& parent) const {
  return read_hrc(parent);
}

TreeStore::HierarchyPiece Potree1Store::read_hrc(const StoredNode& first) const {
  const std::string path = path_of(first, "hrc");
  const InputFile file = open_node_file(path, fmt::format("the nodes below {}", name_of(first)));
  if (file.size() > kMaxPieceBytes)
    throw file_error(path, kMaxPieceBytes, "the file goes on here, and a piece of a hierarchy is never as long.");
  Buffer<std::byte> bytes(static_cast<std::size_t>(file.size()));
  file.read_at(0, bytes);
  count_read(bytes.size());
  return potree1::parse_piece(bytes, first, metadata_.step_size, path);
}

std::string Potree1Store::path_of(const StoredNode& node, std::string_view extension) const {
  return (fs::path(folder_) / fmt::format("{}.{}", potree1::place_of(node, metadata_), extension)).string();
}

std::string Potree1Store::node_path(const StoredNode& node) const {
  switch (metadata_.encoding) {
    case Encoding::bin:
      return path_of(node, "bin");
    case Encoding::las:
      return path_of(node, "las");
    case Encoding::laz:
      return path_of(node, "laz");
  }
  return {};
}

StoredNode Potree1Store::locate(const StoredNode& node) const {
  StoredNode located = node;
  const std::string path = node_path(node);
  std::error_code ignored;
  if (node.points == 0 && !fs::exists(path, ignored)) return located;
  const InputFile file = open_node_file(path, points_of(node));
  located.byte_size = file.size();
  if (metadata_.encoding != Encoding::bin) {
    located.points = las_node_info(path, points_of(node)).point_count;
    count_read(std::min(file.size(), kLasHeaderBytes));
  } else {
    located.points = file.size() / metadata_.rows.bytes;
    if (file.size() % metadata_.rows.bytes != 0)
      throw file_error(path, file.size(),
                       fmt::format("the file ends here, within a point; a multiple of {} bytes was expected by the "
                                   "attributes of cloud.js. It was cut off; copy or build the tree again.",
                                   metadata_.rows.bytes));
  }
  if (located.points == 0) located.byte_size = 0;
  return located;
}

void Potree1Store::decode(const StoredNode& node, std::span<const std::byte> rows,
                          std::span<const std::size_t> attributes, PointBatch& batch) const {
  const std::size_t row = metadata_.rows.bytes;
  batch.positions.resize(rows.size() / row);
  for (std::size_t i = 0; i < batch.positions.size(); ++i)
    std::memcpy(&batch.positions[i], rows.data() + i * row + metadata_.position_place, sizeof(glm::ivec3));
  // Both grids seen from the cube's corner: the world's coordinates would cost digits
  const glm::dvec3 corner = std::ldexp(info_.cube.edge, -node.level) * glm::dvec3(node.cell);
  const GridChange to_tree({corner, glm::dvec3(metadata_.scale)}, {glm::dvec3(0.0), info_.source.grid.scale});
  try {
    to_tree.apply(batch.positions);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. The file is damaged; copy it again.", node_path(node), error.what()));
  }
  decode_columns(rows, metadata_.rows, attributes, batch);
}

void Potree1Store::read_points(const StoredNode& node, std::span<const std::size_t> attributes,
                               PointBatch& batch) const {
  if (node.points == 0) return clear_batch(info_.source.schema, attributes, batch);
  if (metadata_.encoding == Encoding::bin) return read_part(node, 0, node.points, attributes, batch);
  read_las_node(node_path(node), points_of(node), info_.source.schema, attributes, info_.source.grid, batch);
  count_read(node.byte_size);
}

void Potree1Store::read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                             std::span<const std::size_t> attributes, PointBatch& batch) const {
  if (!reads_parts()) return TreeStore::read_part(node, first, count, attributes, batch);
  const std::string path = node_path(node);
  const InputFile file = open_node_file(path, points_of(node));
  const std::uint64_t begin = first * metadata_.rows.bytes, bytes = count * metadata_.rows.bytes;
  // Its size was right when it was located
  if (begin > file.size() || bytes > file.size() - begin)
    throw file_error(path, file.size(), fmt::format("the file ends here, and had {} bytes before.", node.byte_size));
  Buffer<std::byte> rows(static_cast<std::size_t>(bytes));
  file.read_at(begin, rows);
  count_read(bytes);
  decode(node, rows, attributes, batch);
}

bool is_potree1(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(metadata_path(folder_of(path)), ignored);
}

}  // namespace stipple
