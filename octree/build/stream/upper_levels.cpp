#include "octree/build/stream/upper_levels.h"

#include <numeric>
#include <span>
#include <utility>

namespace stipple {
namespace {

void append(const OpenNode& from, OpenNode& to) {
  const auto first = static_cast<std::uint32_t>(to.coded.size());
  for (const CodedPoint& point : from.coded) to.coded.push_back({point.code, point.id + first, point.rank});
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.records.insert(to.records.end(), from.records.begin(), from.records.end());
}

// All points of the nodes, which are emptied one by one.
OpenNode joined(std::span<OpenNode> nodes) {
  std::size_t points = 0, bytes = 0;
  for (const OpenNode& node : nodes) {
    points += node.coded.size();
    bytes += node.records.size();
  }
  OpenNode all;
  all.coded.reserve(points);
  all.positions.reserve(points);
  all.records.reserve(bytes);
  for (OpenNode& node : nodes) {
    append(node, all);
    node = {};
  }
  return all;
}

}  // namespace

void UpperLevels::add(OpenNode&& node, potree2::PackedNodes& packed) {
  while (!path_.empty() && cell_code(node.cell.code, path_.back().cell.level) != path_.back().cell.code)
    close_last(packed);
  for (int level = static_cast<int>(path_.size()); level < node.cell.level; ++level)
    path_.push_back({{level, cell_code(node.cell.code, level)}, {}});
  (path_.empty() ? root_ : path_.back().children).push_back(std::move(node));
}

void UpperLevels::close_last(potree2::PackedNodes& packed) {
  OpenCell closing = std::move(path_.back());
  path_.pop_back();
  std::vector<NodeJoiner::Child> children;
  std::uint32_t first = 0;
  for (const OpenNode& child : closing.children) {
    Buffer<std::uint32_t> offered(child.coded.size());
    std::iota(offered.begin(), offered.end(), first);
    first += static_cast<std::uint32_t>(offered.size());
    children.push_back({child.cell, std::move(offered)});
  }
  const OpenNode all = joined(closing.children);
  const Buffer<std::uint32_t> own = joiner_.join(all.points(), closing.cell.level, children, packed);
  (path_.empty() ? root_ : path_.back().children).push_back(open_node(all.points(), own, closing.cell, record_bytes_));
}

void UpperLevels::finish(potree2::PackedNodes& packed) {
  while (!path_.empty()) close_last(packed);
  if (root_.empty()) return;
  Buffer<std::uint32_t> own(root_.front().coded.size());
  std::iota(own.begin(), own.end(), 0u);
  joiner_.packer().pack(root_.front().points(), own, root_.front().cell, packed);
}

}  // namespace stipple
