#include <fmt/format.h>

#include <cstring>

#include "octree/core/error.h"
#include "octree/store/potree1/format.h"

namespace stipple::potree1 {
namespace {

// What is being read, and where.
struct PieceBytes {
  std::span<const std::byte> bytes;
  const std::string& path;

  std::size_t records() const { return bytes.size() / kRecordBytes; }
  unsigned mask(std::size_t index) const { return std::to_integer<unsigned>(bytes[index * kRecordBytes]); }
  std::uint32_t points(std::size_t index) const {
    std::uint32_t points;
    std::memcpy(&points, bytes.data() + index * kRecordBytes + 1, sizeof points);
    return points;
  }
  Error error(std::size_t index, std::string_view what) const {
    return file_error(path, index * kRecordBytes,
                      fmt::format("{} The file is damaged; build or copy the tree again.", what));
  }
};

void append_children(TreeStore::HierarchyPiece& result, std::uint32_t index, const PieceBytes& piece) {
  const StoredNode parent = result.nodes[index];
  if (parent.level == kMaxStoredLevel)
    throw piece.error(
        index, fmt::format("node {} has children, and at most {} levels are read.", name_of(parent), kMaxStoredLevel));
  for (int child = 0; child < 8; ++child) {
    if ((piece.mask(index) >> child & 1) == 0) continue;
    if (result.nodes.size() == piece.records())
      throw piece.error(piece.records(), fmt::format("the hierarchy piece ends here, and child {} of node {} was "
                                                     "expected.",
                                                     child, name_of(parent)));
    result.nodes[index].children[static_cast<std::size_t>(child)] = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes.push_back(child_of(parent, index, child));
  }
}

}  // namespace

TreeStore::HierarchyPiece parse_piece(std::span<const std::byte> bytes, const StoredNode& first, int step_size,
                                      const std::string& path) {
  const PieceBytes piece{bytes, path};
  if (bytes.empty() || bytes.size() % kRecordBytes != 0)
    throw file_error(
        path, bytes.size(),
        fmt::format("the file ends here; a multiple of {} bytes above 0 was expected. It was cut off; copy "
                    "or build the tree again.",
                    kRecordBytes));
  TreeStore::HierarchyPiece result;
  result.nodes.emplace_back();
  result.nodes[0].level = first.level;
  result.nodes[0].cell = first.cell;
  for (std::uint32_t i = 0; i < result.nodes.size(); ++i) {
    result.nodes[i].points = piece.points(i);
    if (piece.mask(i) == 0) continue;
    if (result.nodes[i].level - first.level < step_size)
      append_children(result, i, piece);
    else
      result.continued.push_back({i, 0, 0});
  }
  if (result.nodes.size() != piece.records())
    throw piece.error(result.nodes.size(),
                      fmt::format("the hierarchy piece of node {} has {} nodes, and {} by their child masks were "
                                  "expected.",
                                  name_of(first), piece.records(), result.nodes.size()));
  return result;
}

std::string place_of(const StoredNode& node, const Metadata& metadata) {
  const std::string name = name_of(node);
  if (metadata.step_size == 0) return fmt::format("{}/{}", metadata.octree_folder, name);
  std::string place = metadata.octree_folder + "/r/";
  const auto step = static_cast<std::size_t>(metadata.step_size);
  for (std::size_t digit = 1; digit + step <= name.size(); digit += step) place += name.substr(digit, step) + "/";
  return place + name;
}

}  // namespace stipple::potree1
