#include "octree/store/potree2/potree2_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "octree/core/error.h"
#include "octree/store/json_value.h"
#include "octree/store/potree2/kd_boxes.h"
#include "octree/store/potree2/node_points.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMetadataName = "metadata.json";
// PotreeConverter picks the cell before it rounds the point to the grid, on which the cell's corners need not be: in
// the lion of the Potree project, points are up to 0.75 grid steps outside.
constexpr double kCellMargin = 1.0;

fs::path folder_of(const std::string& path) {
  const fs::path name = fs::path(path).filename();
  return name == kMetadataName || name == potree2::kKdMetadataName ? fs::path(path).parent_path() : fs::path(path);
}

std::string file_beside(const std::string& path, std::string_view name) {
  return (folder_of(path) / name).string();
}

bool is_kd(const std::string& path) {
  std::error_code ignored;
  return !fs::exists(file_beside(path, kMetadataName), ignored) &&
         fs::is_regular_file(file_beside(path, potree2::kKdMetadataName), ignored);
}

std::string metadata_file(const std::string& path) {
  return file_beside(path, is_kd(path) ? potree2::kKdMetadataName : kMetadataName);
}

potree2::Metadata load_metadata(const std::string& path) {
  return potree2::parse_metadata(read_json_file(path), path);
}

// The box that the metadata state for positions; the root's cell where they do not.
WorldBox stated_bounds(const potree2::Metadata& metadata) {
  const AttributeRange& range = metadata.ranges.at(0);
  WorldBox box;
  for (int axis = 0; axis < 3; ++axis) {
    if (range.min.size() != 3 || range.max.size() != 3 || !(range.min[axis] <= range.max[axis])) return metadata.cube;
    box.min[axis] = range.min[axis];
    box.max[axis] = range.max[axis];
  }
  return box;
}

TreeInfo describe(const potree2::Metadata& metadata, const std::string& path) {
  const std::size_t record = potree2::record_bytes(metadata.schema);
  TreeInfo info;
  info.source.path = path;
  info.source.format = "Potree octree";
  info.source.version = "2.0";
  info.source.encoding = metadata.encoding == potree2::Encoding::brotli
                             ? fmt::format("brotli, {} bytes a point unpacked", record)
                             : fmt::format("records of {} bytes a point", record);
  info.source.point_count = metadata.points;
  info.source.grid = metadata.grid;
  info.source.schema = metadata.schema;
  info.source.stated_bounds = metadata.points == 0 ? WorldBox{} : stated_bounds(metadata);
  const glm::dvec3 size = metadata.cube.max - metadata.cube.min;
  info.cube = {metadata.cube.min, std::max({size.x, size.y, size.z})};
  info.spacing = metadata.spacing;
  info.cell_margin = kCellMargin * metadata.grid.scale;
  info.position_range = metadata.ranges.at(0);
  info.ranges.assign(metadata.ranges.begin() + 1, metadata.ranges.end());
  return info;
}

// Columns of BROTLI nodes that have their own layout have one type alone.
void check_colours(const potree2::Metadata& metadata, const std::string& path) {
  if (metadata.encoding != potree2::Encoding::brotli) return;
  for (const Attribute& attribute : metadata.schema)
    if (potree2::brotli_bytes(attribute) != attribute.bytes() &&
        (attribute.type != ScalarType::u16 || attribute.components != 3))
      throw Error(fmt::format("{}: attributes: \"{}\" is {} x {}, and 3 x uint16 was expected with encoding BROTLI.",
                              path, attribute.name, attribute.components, name_of(attribute.type)));
}

}  // namespace

Potree2Store::Potree2Store(const std::string& path)
    : metadata_(load_metadata(metadata_file(path))),
      hierarchy_(file_beside(path, "hierarchy.bin")),
      points_(file_beside(path, "octree.bin")),
      point_file_{points_.size(), potree2::record_bytes(metadata_.schema), metadata_.encoding},
      info_(describe(metadata_, path)) {
  count_read(fs::file_size(metadata_file(path)));
  info_.point_bytes = points_.size();
  info_.hierarchy_bytes = hierarchy_.size();
  sidecar_ = potree2::read_sidecar(folder_of(path).string(), metadata_.points, points_.size(), info_.source.warnings);
  info_.has_details = sidecar_ != nullptr;
  if (sidecar_ && sidecar_->header().fraction > 0.0) info_.minimal_distance = sidecar_->header().fraction;
  check_colours(metadata_, metadata_file(path));
  if (metadata_.first_piece_bytes > 0 || metadata_.points > 0)
    root_piece_ = read_piece_at(0, metadata_.first_piece_bytes, StoredNode{});
  if (is_kd(path)) take_boxes(folder_of(path).string());
}

void Potree2Store::take_boxes(const std::string& folder) {
  info_.source.format = "kd tree";
  info_.source.version = "1.0";
  if (root_piece_.nodes.empty()) return;
  if (!root_piece_.continued.empty())
    throw Error(
        fmt::format("{}: was expected to be one piece, and refers to others. The tree is damaged; build or copy "
                    "it again.",
                    hierarchy_.path()));
  count_read(potree2::read_boxes(folder, root_piece_.nodes));
}

TreeStore::HierarchyPiece Potree2Store::read_piece(const HierarchyPiece::Continuation& where,
                                                   const StoredNode& parent) const {
  return read_piece_at(where.piece, where.piece_size, parent);
}

TreeStore::HierarchyPiece Potree2Store::read_piece_at(std::uint64_t offset, std::uint64_t bytes,
                                                      const StoredNode& first) const {
  if (offset > hierarchy_.size() || bytes > hierarchy_.size() - offset)
    throw file_error(hierarchy_.path(), std::min(offset, hierarchy_.size()),
                     fmt::format("the hierarchy piece of node {} was expected in bytes {} + {}, and the file has {}. "
                                 "It was cut off or damaged; build or copy the tree again.",
                                 name_of(first), offset, bytes, hierarchy_.size()));
  if (bytes == 0 || bytes % potree2::kRecordBytes != 0)
    throw file_error(hierarchy_.path(), offset,
                     fmt::format("the hierarchy piece of node {} has {} bytes; a multiple of {} above 0 was expected. "
                                 "The tree is damaged; build or copy it again.",
                                 name_of(first), bytes, potree2::kRecordBytes));
  Buffer<std::byte> piece(static_cast<std::size_t>(bytes));
  hierarchy_.read_at(offset, piece);
  count_read(bytes);
  return potree2::read_piece(piece, offset, first, point_file_, hierarchy_.path());
}

void Potree2Store::read_points(const StoredNode& node, std::span<const std::size_t> attributes,
                               PointBatch& batch) const {
  Buffer<std::byte> bytes(static_cast<std::size_t>(node.byte_size));
  points_.read_at(node.byte_offset, bytes);
  count_read(node.byte_size);
  const auto points = static_cast<std::size_t>(node.points);
  if (metadata_.encoding == potree2::Encoding::uncompressed || node.byte_size == 0) {
    potree2::decode_records(bytes, points, metadata_.schema, attributes, batch);
    return;
  }
  try {
    potree2::decode_brotli(bytes, points, metadata_.schema, attributes, batch);
  } catch (const Error& error) {
    throw file_error(points_.path(), node.byte_offset,
                     fmt::format("the {} points of node {} were expected in {} bytes, but {}. The file is damaged; "
                                 "build or copy the tree again.",
                                 points, name_of(node), node.byte_size, error.what()));
  }
}

void Potree2Store::read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                             std::span<const std::size_t> attributes, PointBatch& batch) const {
  if (!reads_parts()) return TreeStore::read_part(node, first, count, attributes, batch);
  const std::uint64_t record = potree2::record_bytes(metadata_.schema);
  StoredNode part = node;
  part.points = count;
  part.byte_offset += first * record;
  part.byte_size = count * record;
  read_points(part, attributes, batch);
}

NodeDetails Potree2Store::read_details(const StoredNode& node) const {
  const auto found = sidecar_->find(node.byte_offset);
  if (!found || found->points != node.points || found->level != static_cast<std::uint32_t>(node.level))
    throw Error(fmt::format("{}: {}: node {} with {} points on level {} was expected, and is not there.",
                            info_.source.path, potree2::kSidecarName, name_of(node), node.points, node.level));
  NodeDetails details{found->box, found->profile, sidecar_->clusters(*found)};
  count_read(sidecar_->bytes_of(*found));
  return details;
}

bool is_potree2(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(metadata_file(path), ignored) &&
         (fs::exists(file_beside(path, "hierarchy.bin"), ignored) ||
          fs::exists(file_beside(path, "octree.bin"), ignored));
}

}  // namespace stipple
