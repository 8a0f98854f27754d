#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>
#include <optional>

#include "octree/core/error.h"
#include "octree/store/ept/format.h"
#include "octree/store/json_value.h"

namespace stipple::ept {
namespace {

constexpr std::uint64_t kMaxNodePoints = std::uint64_t{1} << 40;
constexpr std::int64_t kElsewhere = -1;  // the node's own page lists it

using Key = std::array<std::uint32_t, 4>;  // level, x, y, z

// "2-0-3-1"; nothing when `text` is none.
std::optional<Key> parse_key(std::string_view text) {
  Key key;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (i > 0 && (at == end || *at++ != '-')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, key[i]);
    if (error != std::errc()) return std::nullopt;
    at = next;
  }
  if (at != end || key[0] > static_cast<std::uint32_t>(kMaxStoredLevel)) return std::nullopt;
  for (std::size_t i = 1; i < key.size(); ++i)
    if (key[i] >> key[0] != 0) return std::nullopt;
  return key;
}

Key key_in_numbers(const StoredNode& node) {
  return {static_cast<std::uint32_t>(node.level), node.cell.x, node.cell.y, node.cell.z};
}

bool is_below(const Key& key, const Key& ancestor) {
  if (key[0] < ancestor[0]) return false;
  for (std::size_t i = 1; i < key.size(); ++i)
    if (key[i] >> (key[0] - ancestor[0]) != ancestor[i]) return false;
  return true;
}

Key parent_of(const Key& key) {
  return {key[0] - 1, key[1] >> 1, key[2] >> 1, key[3] >> 1};
}

// What the page says of its nodes; nodes that it only implies hold no points.
using Counts = std::map<Key, std::int64_t>;

Counts parse_counts(const nlohmann::ordered_json& document, const Key& first, const std::string& path) {
  const JsonValue json(document, path);
  Counts counts;
  if (!document.is_object()) throw json.error("an object with a number of points for every node was expected.");
  for (const auto& [name, value] : document.items()) {
    const auto key = parse_key(name);
    if (!key || !is_below(*key, first))
      throw json.error(
          fmt::format("\"{}\" is no node of this page: level, x, y and z of a node at or below "
                      "{}-{}-{}-{} were expected. The file is damaged; copy it again.",
                      name, first[0], first[1], first[2], first[3]));
    if (value.is_number_integer() && value == kElsewhere)
      counts[*key] = kElsewhere;
    else
      counts[*key] = static_cast<std::int64_t>(json[name].whole(0, kMaxNodePoints));
  }
  const bool implied = first[0] == 0;
  if (!implied && !counts.empty() && !counts.contains(first))
    throw json.error("the node that the page is named after was expected in it. The file is damaged; copy it again.");
  const Counts listed = counts;
  for (const auto& entry : listed)
    for (Key key = entry.first; key != first;) {
      key = parent_of(key);
      if (!counts.try_emplace(key, 0).second) break;
    }
  return counts;
}

void append_children(TreeStore::HierarchyPiece& piece, std::uint32_t index, const Counts& counts) {
  if (piece.nodes[index].level == kMaxStoredLevel) return;
  for (int child = 0; child < 8; ++child) {
    const StoredNode node = child_of(piece.nodes[index], index, child);
    if (!counts.contains(key_in_numbers(node))) continue;
    piece.nodes[index].children[static_cast<std::size_t>(child)] = static_cast<std::uint32_t>(piece.nodes.size());
    piece.nodes.push_back(node);
  }
}

}  // namespace

std::string key_of(const StoredNode& node) {
  return fmt::format("{}-{}-{}-{}", node.level, node.cell.x, node.cell.y, node.cell.z);
}

TreeStore::HierarchyPiece parse_page(const std::string& text, const StoredNode& first, const std::string& path) {
  const auto document = parse_json(text, path);
  const Counts counts = parse_counts(document, key_in_numbers(first), path);
  TreeStore::HierarchyPiece piece;
  if (counts.empty()) return piece;
  piece.nodes.emplace_back();
  piece.nodes[0].level = first.level;
  piece.nodes[0].cell = first.cell;
  for (std::uint32_t i = 0; i < piece.nodes.size(); ++i) {
    const std::int64_t count = counts.at(key_in_numbers(piece.nodes[i]));
    if (count != kElsewhere) {
      piece.nodes[i].points = static_cast<std::uint64_t>(count);
      append_children(piece, i, counts);
      continue;
    }
    if (i == 0)
      throw Error(
          fmt::format("{}: {}: the page refers to itself; the node's number of points was expected. The file is "
                      "damaged; copy it again.",
                      path, key_of(first)));
    piece.continued.push_back({i, 0, 0});
  }
  return piece;
}

}  // namespace stipple::ept
