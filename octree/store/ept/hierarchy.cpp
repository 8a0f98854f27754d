#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "octree/core/error.h"
#include "octree/store/ept/format.h"

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

// Reads a page as it comes: a document that keeps the order of its keys takes time with the square of their number.
class PageReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  PageReader(const Key& first, const std::string& path) : first_(first), path_(path) {}

  Counts take() { return std::move(counts_); }

  bool start_object(std::size_t) override { return std::exchange(begun_, true) ? wrong("an object") : true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return wrong("a list"); }
  bool end_array() override { return true; }
  bool null() override { return wrong("null"); }
  bool boolean(bool) override { return wrong("a truth value"); }
  bool string(std::string&) override { return wrong("a text"); }
  bool binary(binary_t&) override { return wrong("bytes"); }
  bool number_float(double, const std::string& text) override { return wrong(text); }
  bool number_integer(std::int64_t value) override { return take_number(value); }
  bool number_unsigned(std::uint64_t value) override {
    if (value > kMaxNodePoints) return wrong(fmt::format("{}", value));
    return take_number(static_cast<std::int64_t>(value));
  }

  bool key(std::string& name) override {
    const auto key = parse_key(name);
    if (!key || !is_below(*key, first_))
      throw Error(
          fmt::format("{}: \"{}\" is no node of this page: level, x, y and z of a node at or below "
                      "{}-{}-{}-{} were expected. The file is damaged; copy it again.",
                      path_, name, first_[0], first_[1], first_[2], first_[3]));
    key_ = *key;
    name_ = name;
    return true;
  }

  bool parse_error(std::size_t place, const std::string&, const nlohmann::json::exception&) override {
    // The library counts bytes from 1
    throw file_error(path_, place - std::min<std::size_t>(place, 1),
                     "this is no JSON any more. The file was cut off or damaged; copy it again.");
  }

 private:
  bool take_number(std::int64_t value) {
    if (!begun_ || value < kElsewhere) return wrong(fmt::format("{}", value));
    counts_[key_] = value;
    return true;
  }
  bool wrong(const std::string& found) const {
    throw Error(fmt::format("{}: {}: {} was found, and {} was expected. The file is damaged; copy it again.", path_,
                            name_, found, begun_ ? "a whole number of points, or -1," : "an object"));
  }

  const Key& first_;
  const std::string& path_;
  Counts counts_;
  Key key_{};
  std::string name_ = "the page";
  bool begun_ = false;
};

Counts parse_counts(const std::string& text, const Key& first, const std::string& path) {
  PageReader reader(first, path);
  nlohmann::json::sax_parse(text, &reader);
  Counts counts = reader.take();
  const bool implied = first[0] == 0;
  if (!implied && !counts.empty() && !counts.contains(first))
    throw Error(
        fmt::format("{}: the node that the page is named after was expected in it. The file is damaged; copy it "
                    "again.",
                    path));
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
  const Counts counts = parse_counts(text, key_in_numbers(first), path);
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
