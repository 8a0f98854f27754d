#include "octree/store/potree2/hierarchy.h"

#include <fmt/format.h>

#include "octree/core/error.h"

namespace stipple::potree2 {
namespace {

// What is being read, and where.
struct PieceBytes {
  std::span<const std::byte> bytes;
  std::uint64_t offset;
  const std::string& path;

  std::size_t records() const { return bytes.size() / kRecordBytes; }
  Record record(std::size_t index) const { return read_record(bytes.data() + index * kRecordBytes); }
  Error error(std::size_t index, std::string_view what) const {
    return file_error(path, offset + index * kRecordBytes,
                      fmt::format("{} The file is damaged; build or copy the tree again.", what));
  }
};

void check_byte_range(const StoredNode& node, const PointFile& points, const PieceBytes& piece, std::size_t index) {
  if (node.byte_offset > points.bytes || node.byte_size > points.bytes - node.byte_offset)
    throw piece.error(index, fmt::format("node {} states bytes {} + {} of octree.bin, which has {}.", name_of(node),
                                         node.byte_offset, node.byte_size, points.bytes));
  if (points.encoding == Encoding::uncompressed && node.byte_size != node.points * points.record_bytes)
    throw piece.error(index, fmt::format("node {} states {} points in {} bytes; {} bytes were expected.", name_of(node),
                                         node.points, node.byte_size, node.points * points.record_bytes));
  if (node.byte_size > 0 && node.points == 0)
    throw piece.error(index, fmt::format("node {} states no points in {} bytes.", name_of(node), node.byte_size));
}

void take_points(StoredNode& node, const Record& record, const PointFile& points, const PieceBytes& piece,
                 std::size_t index) {
  if (record.byte_size == 0) return;
  node.points = record.points;
  node.byte_offset = record.byte_offset;
  node.byte_size = record.byte_size;
  check_byte_range(node, points, piece, index);
}

void append_children(TreeStore::HierarchyPiece& result, std::uint32_t index, const Record& record,
                     const PieceBytes& piece) {
  const StoredNode parent = result.nodes[index];
  if (record.child_mask != 0 && parent.level == kMaxStoredLevel)
    throw piece.error(
        index, fmt::format("node {} has children, and at most {} levels are read.", name_of(parent), kMaxStoredLevel));
  for (int child = 0; child < 8; ++child) {
    if ((record.child_mask >> child & 1) == 0) continue;
    if (result.nodes.size() == piece.records())
      throw piece.error(piece.records(), fmt::format("the hierarchy piece ends here, and child {} of node {} was "
                                                     "expected.",
                                                     child, name_of(parent)));
    result.nodes[index].children[child] = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes.push_back(child_of(parent, index, child));
  }
}

void continue_elsewhere(TreeStore::HierarchyPiece& result, std::uint32_t index, const Record& record,
                        const PieceBytes& piece) {
  if (index == 0)
    throw piece.error(index, fmt::format("the hierarchy piece of node {} begins with a reference to another; the node "
                                         "itself was expected.",
                                         name_of(result.nodes[index])));
  result.nodes[index].points = record.points;
  result.continued.push_back({index, record.byte_offset, record.byte_size});
}

}  // namespace

TreeStore::HierarchyPiece read_piece(std::span<const std::byte> bytes, std::uint64_t piece_offset,
                                     const StoredNode& first, const PointFile& points, const std::string& path) {
  const PieceBytes piece{bytes, piece_offset, path};
  TreeStore::HierarchyPiece result;
  result.nodes.emplace_back();
  result.nodes[0].level = first.level;
  result.nodes[0].cell = first.cell;
  for (std::uint32_t i = 0; i < result.nodes.size(); ++i) {
    const Record record = piece.record(i);
    if (record.type > NodeType::proxy)
      throw piece.error(i, fmt::format("node {} is of type {}, and 0, 1 or 2 was expected.", name_of(result.nodes[i]),
                                       static_cast<int>(record.type)));
    if (record.type == NodeType::proxy) {
      continue_elsewhere(result, i, record, piece);
      continue;
    }
    take_points(result.nodes[i], record, points, piece, i);
    append_children(result, i, record, piece);
  }
  if (result.nodes.size() != piece.records())
    throw piece.error(result.nodes.size(),
                      fmt::format("the hierarchy piece of node {} has {} nodes, and {} by their child masks were "
                                  "expected.",
                                  name_of(result.nodes[0]), piece.records(), result.nodes.size()));
  return result;
}

}  // namespace stipple::potree2
