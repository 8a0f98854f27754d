#include "octree/store/potree2/writer_hierarchy.h"

#include <algorithm>
#include <array>

#include "octree/build/morton.h"
#include "octree/store/potree2/format.h"

namespace stipple::potree2 {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct LinkedNode {
  NodeEntry entry;
  std::array<std::uint32_t, 8> children;

  std::uint8_t child_mask() const {
    unsigned mask = 0;
    for (unsigned digit = 0; digit < 8; ++digit)
      if (children[digit] != kNone) mask |= 1u << digit;
    return static_cast<std::uint8_t>(mask);
  }
};

// Adds a node, and those between it and the nodes on the path that are not there, to a list in preorder.
class Linker {
 public:
  explicit Linker(std::size_t nodes) { linked_.reserve(nodes); }

  void add(const NodeEntry& entry) {
    while (!path_.empty() && !holds(linked_[path_.back()].entry, entry)) path_.pop_back();
    for (int level = static_cast<int>(path_.size()); level < entry.level; ++level)
      push({.code = cell_code(entry.code, level), .level = level});
    push(entry);
  }

  std::vector<LinkedNode> take() { return std::move(linked_); }

 private:
  static bool holds(const NodeEntry& above, const NodeEntry& entry) {
    return above.level < entry.level && cell_code(entry.code, above.level) == above.code;
  }

  void push(const NodeEntry& entry) {
    const auto index = static_cast<std::uint32_t>(linked_.size());
    if (!path_.empty()) linked_[path_.back()].children[morton_digit(entry.code, entry.level)] = index;
    LinkedNode& node = linked_.emplace_back();
    node.entry = entry;
    node.children.fill(kNone);
    path_.push_back(index);
  }

  std::vector<LinkedNode> linked_;
  std::vector<std::uint32_t> path_;  // from the root to the latest node
};

struct Piece {
  std::vector<std::uint32_t> nodes;  // breadth first
  std::uint64_t byte_offset = 0;

  std::uint64_t bytes() const { return nodes.size() * kRecordBytes; }
};

class PieceWriter {
 public:
  PieceWriter(const std::vector<LinkedNode>& nodes, int step_size) : nodes_(nodes), step_size_(step_size) {
    std::uint64_t offset = 0;
    std::vector<std::uint32_t> roots{0};
    for (std::size_t p = 0; p < roots.size(); ++p) {
      pieces_.push_back({list(roots[p]), offset});
      offset += pieces_.back().bytes();
      for (const std::uint32_t node : pieces_.back().nodes)
        if (continues(node, roots[p])) roots.push_back(node);
    }
  }

  HierarchyFile write() const {
    HierarchyFile file;
    file.bytes.resize(pieces_.back().byte_offset + pieces_.back().bytes());
    file.first_piece_bytes = pieces_.front().bytes();
    std::byte* at = file.bytes.data();
    std::size_t next = 1;  // piece that the next proxy leads to
    for (const Piece& piece : pieces_)
      for (const std::uint32_t node : piece.nodes) {
        const bool proxy = continues(node, piece.nodes.front());
        write_record(record_of(node, proxy ? &pieces_[next++] : nullptr), at);
        at += kRecordBytes;
      }
    return file;
  }

 private:
  bool continues(std::uint32_t node, std::uint32_t root) const {
    return nodes_[node].entry.level == nodes_[root].entry.level + step_size_ && nodes_[node].child_mask() != 0;
  }

  std::vector<std::uint32_t> list(std::uint32_t root) const {
    std::vector<std::uint32_t> listed{root};
    for (std::size_t i = 0; i < listed.size(); ++i) {
      if (continues(listed[i], root)) continue;
      for (const std::uint32_t child : nodes_[listed[i]].children)
        if (child != kNone) listed.push_back(child);
    }
    return listed;
  }

  Record record_of(std::uint32_t node, const Piece* continuation) const {
    const LinkedNode& linked = nodes_[node];
    Record record{linked.child_mask() == 0 ? NodeType::leaf : NodeType::inner, linked.child_mask(), linked.entry.points,
                  linked.entry.byte_offset, linked.entry.byte_size};
    if (!continuation) return record;
    record.type = NodeType::proxy;
    record.byte_offset = continuation->byte_offset;
    record.byte_size = continuation->bytes();
    return record;
  }

  const std::vector<LinkedNode>& nodes_;
  int step_size_;
  std::vector<Piece> pieces_;
};

}  // namespace

HierarchyFile write_hierarchy(std::vector<NodeEntry> nodes, int step_size) {
  if (nodes.empty()) nodes.emplace_back();
  std::ranges::sort(nodes, [](const NodeEntry& a, const NodeEntry& b) {
    return a.code != b.code ? a.code < b.code : a.level < b.level;
  });
  Linker linker(nodes.size());
  for (const NodeEntry& node : nodes) linker.add(node);
  const std::vector<LinkedNode> linked = linker.take();
  HierarchyFile file = PieceWriter(linked, step_size).write();
  file.nodes = linked.size();
  for (const LinkedNode& node : linked) file.depth = std::max(file.depth, node.entry.level);
  return file;
}

}  // namespace stipple::potree2
