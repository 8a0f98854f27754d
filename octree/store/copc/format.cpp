#include "octree/store/copc/format.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "octree/core/error.h"

namespace stipple::copc {
namespace {

// Info record: byte offsets.
constexpr std::size_t kCenter = 0;     // f64[3]
constexpr std::size_t kHalfEdge = 24;  // f64
constexpr std::size_t kSpacing = 32;   // f64
constexpr std::size_t kRootPage = 40;  // u64
constexpr std::size_t kRootPageBytes = 48;
constexpr std::size_t kGpsTimeMin = 56;  // f64
constexpr std::size_t kGpsTimeMax = 64;

constexpr std::int32_t kIsPage = -1;  // number of points of an entry that stands for another page

template <class T>
T load(std::span<const std::byte> bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Level, then cell.
using Key = std::array<std::int32_t, 4>;

struct Entry {
  std::uint64_t offset = 0;
  std::int32_t bytes = 0;
  std::int32_t points = 0;
  std::size_t at = 0;  // in the page
};

std::string text_of(const Key& key) {
  return fmt::format("{}-{}-{}-{}", key[0], key[1], key[2], key[3]);
}

Key key_of(const StoredNode& node) {
  return {node.level, static_cast<std::int32_t>(node.cell.x), static_cast<std::int32_t>(node.cell.y),
          static_cast<std::int32_t>(node.cell.z)};
}

class PageReader {
 public:
  explicit PageReader(const Page& page) : page_(page) {
    for (std::size_t at = 0; at + kEntryBytes <= page.bytes.size(); at += kEntryBytes) add(at);
  }

  TreeStore::HierarchyPiece read(const StoredNode& first) {
    TreeStore::HierarchyPiece piece;
    piece.nodes.emplace_back();
    piece.nodes[0].level = first.level;
    piece.nodes[0].cell = first.cell;
    if (!take(piece, 0)) throw error(0, fmt::format("begins with no entry of node {}.", text_of(key_of(first))));
    for (std::uint32_t i = 0; i < piece.nodes.size(); ++i) append_children(piece, i);
    if (!entries_.empty()) {
      const auto& [key, entry] = *entries_.begin();
      throw error(entry.at, fmt::format("has an entry of node {}, whose parent has none in it.", text_of(key)));
    }
    return piece;
  }

 private:
  void add(std::size_t at) {
    Key key;
    std::memcpy(key.data(), page_.bytes.data() + at, sizeof key);
    Entry entry{load<std::uint64_t>(page_.bytes, at + 16), load<std::int32_t>(page_.bytes, at + 24),
                load<std::int32_t>(page_.bytes, at + 28), at};
    if (entry.points < kIsPage || entry.bytes < 0 || (entry.points > 0 && entry.bytes == 0))
      throw error(at,
                  fmt::format("states {} points in {} bytes for node {}.", entry.points, entry.bytes, text_of(key)));
    const auto bytes = static_cast<std::uint64_t>(entry.bytes);
    if (entry.points != 0 && (entry.offset > page_.file_bytes || bytes > page_.file_bytes - entry.offset))
      throw error(at, fmt::format("states bytes {} + {} for node {}, and the file has {}.", entry.offset, bytes,
                                  text_of(key), page_.file_bytes));
    if (!entries_.emplace(key, entry).second) throw error(at, fmt::format("has node {} twice.", text_of(key)));
  }

  // Moves the entry of a node to it; false when there is none.
  bool take(TreeStore::HierarchyPiece& piece, std::uint32_t index) {
    StoredNode& node = piece.nodes[index];
    const auto found = entries_.find(key_of(node));
    if (found == entries_.end()) return false;
    const Entry entry = found->second;
    entries_.erase(found);
    if (entry.points == kIsPage) {
      if (index == 0)
        throw error(entry.at, fmt::format("begins with a reference to another page for node {}; the node itself was "
                                          "expected.",
                                          text_of(key_of(node))));
      piece.continued.push_back({index, entry.offset, static_cast<std::uint64_t>(entry.bytes)});
    } else if (entry.points > 0) {
      node.points = static_cast<std::uint64_t>(entry.points);
      node.byte_offset = entry.offset;
      node.byte_size = static_cast<std::uint64_t>(entry.bytes);
    }
    return true;
  }

  void append_children(TreeStore::HierarchyPiece& piece, std::uint32_t index) {
    if (piece.nodes[index].level == kMaxStoredLevel) return;
    for (int child = 0; child < 8; ++child) {
      const StoredNode node = child_of(piece.nodes[index], index, child);
      const auto place = static_cast<std::uint32_t>(piece.nodes.size());
      if (!entries_.contains(key_of(node))) continue;
      piece.nodes.push_back(node);
      take(piece, place);
      piece.nodes[index].children[static_cast<std::size_t>(child)] = place;
    }
  }

  Error error(std::size_t at, std::string_view what) const {
    return file_error(
        page_.path, page_.offset + at,
        fmt::format("the hierarchy page at byte {} {} The file is damaged; copy it again.", page_.offset, what));
  }

  const Page& page_;
  std::map<Key, Entry> entries_;  // not yet in the tree
};

}  // namespace

Info parse_info(std::span<const std::byte> body, std::uint64_t offset, const std::string& path) {
  if (body.size() < kInfoBytes)
    throw file_error(path, offset,
                     fmt::format("the record \"{}\" has {} bytes, and {} were expected. The file is damaged; copy it "
                                 "again.",
                                 kUserId, body.size(), kInfoBytes));
  Info info;
  for (int axis = 0; axis < 3; ++axis)
    info.center[axis] = load<double>(body, kCenter + sizeof(double) * static_cast<std::size_t>(axis));
  info.half_edge = load<double>(body, kHalfEdge);
  info.spacing = load<double>(body, kSpacing);
  info.root_page = load<std::uint64_t>(body, kRootPage);
  info.root_page_bytes = load<std::uint64_t>(body, kRootPageBytes);
  info.gps_time_min = load<double>(body, kGpsTimeMin);
  info.gps_time_max = load<double>(body, kGpsTimeMax);
  const bool is_cube = std::isfinite(info.center.x) && std::isfinite(info.center.y) && std::isfinite(info.center.z) &&
                       std::isfinite(info.half_edge) && info.half_edge >= 0.0;
  if (!is_cube)
    throw file_error(path, offset,
                     fmt::format("the record \"{}\" states no cube: center {}, {}, {}, half its edge {}. The file is "
                                 "damaged; copy it again.",
                                 kUserId, info.center.x, info.center.y, info.center.z, info.half_edge));
  return info;
}

TreeStore::HierarchyPiece parse_page(const Page& page, const StoredNode& first) {
  if (page.bytes.empty() || page.bytes.size() % kEntryBytes != 0)
    throw file_error(page.path, page.offset,
                     fmt::format("the hierarchy page here has {} bytes; a multiple of {} above 0 was expected. The "
                                 "file is damaged; copy it again.",
                                 page.bytes.size(), kEntryBytes));
  return PageReader(page).read(first);
}

}  // namespace stipple::copc
