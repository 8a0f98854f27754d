#include "octree/build/stream/chunk_builder.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "octree/build/sort.h"
#include "octree/build/stream/record.h"

namespace stipple {

Buffer<std::uint32_t> NodeJoiner::join(const SortedPoints& points, int level, std::span<const Child> children,
                                       potree2::PackedNodes& packed) {
  candidates_.clear();
  for (const Child& child : children) candidates_.insert(candidates_.end(), child.offered.begin(), child.offered.end());
  sampler_.select(points, candidates_, level, taken_);
  Buffer<std::uint32_t> own;
  std::size_t at = 0;
  for (const Child& child : children) {
    left_.clear();
    for (const std::uint32_t i : child.offered) (taken_[at++] ? own : left_).push_back(i);
    packer_.pack(points, left_, child.cell, packed);
  }
  return own;
}

OpenNode open_node(const SortedPoints& points, std::span<const std::uint32_t> own, const CellId& cell,
                   std::size_t record_bytes) {
  OpenNode node;
  node.cell = cell;
  node.coded.resize(own.size());
  node.positions.resize(own.size());
  node.records.resize(own.size() * record_bytes);
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    node.coded[i] = points.coded[own[i]];
    node.positions[i] = points.positions[own[i]];
    copy_record(points.records + std::size_t{node.coded[i].id} * record_bytes, record_bytes,
                node.records.data() + i * record_bytes);
    node.coded[i].id = i;
  }
  return node;
}

ChunkBuilder::ChunkBuilder(const StreamOptions& options, const CubeFrame& frame, std::size_t record_bytes)
    : options_(options),
      record_bytes_(record_bytes),
      quantizer_(frame.grid, frame.bounds),
      joiner_(options, frame, record_bytes) {}

// Points of one code and rank, equal in every byte but for rare collisions of the hash, in the order of their bytes.
void ChunkBuilder::order_equals() {
  const auto same = [](const CodedPoint& a, const CodedPoint& b) { return a.code == b.code && a.rank == b.rank; };
  for (std::size_t first = 0; first + 1 < coded_.size(); ++first) {
    if (!same(coded_[first], coded_[first + 1])) continue;
    std::size_t last = first + 1;
    while (last < coded_.size() && same(coded_[first], coded_[last])) ++last;
    std::sort(coded_.begin() + first, coded_.begin() + last, [this](const CodedPoint& a, const CodedPoint& b) {
      return std::memcmp(records_ + std::size_t{a.id} * record_bytes_, records_ + std::size_t{b.id} * record_bytes_,
                         record_bytes_) < 0;
    });
    first = last - 1;
  }
}

void ChunkBuilder::sort(const CellId& cell) {
  scratch_.resize(coded_.size());
  for (std::uint32_t i = 0; i < coded_.size(); ++i) {
    const std::byte* const record = records_ + i * record_bytes_;
    coded_[i] = {quantizer_.code(position_of(record)), i, rank_of(record, record_bytes_, options_.seed)};
  }
  sort_points(coded_, scratch_, cell.level);
  order_equals();
  positions_.resize(coded_.size());
  for (std::size_t i = 0; i < coded_.size(); ++i)
    positions_[i] = position_of(records_ + std::size_t{coded_[i].id} * record_bytes_);
}

// Returns the points of the node that covers [first, last); packs the nodes below it.
Buffer<std::uint32_t> ChunkBuilder::grow(const CellId& cell, std::uint32_t first, std::uint32_t last,
                                         potree2::PackedNodes& packed) {
  const SortedPoints points{coded_, positions_, records_};
  if (last - first <= options_.leaf_capacity || coded_[first].code == coded_[last - 1].code) {
    Buffer<std::uint32_t> own(last - first);
    std::iota(own.begin(), own.end(), first);
    return own;
  }
  std::vector<NodeJoiner::Child> children;
  const int level = cell.level + 1;
  for (std::uint32_t begin = first; begin < last;) {
    const CellId child{level, cell_code(coded_[begin].code, level)};
    const auto end = std::partition_point(coded_.begin() + begin, coded_.begin() + last, [&](const CodedPoint& point) {
      return cell_code(point.code, level) == child.code;
    });
    const auto next = static_cast<std::uint32_t>(end - coded_.begin());
    children.push_back({child, grow(child, begin, next, packed)});
    begin = next;
  }
  return joiner_.join(points, cell.level, children, packed);
}

BuiltChunk ChunkBuilder::build(const CellId& cell, std::span<const std::byte> records) {
  BuiltChunk chunk;
  records_ = records.data();
  const auto count = static_cast<std::uint32_t>(records.size() / record_bytes_);
  coded_.resize(count);
  chunk.below.bytes.reserve(records.size());
  sort(cell);
  const Buffer<std::uint32_t> own = grow(cell, 0, count, chunk.below);
  const SortedPoints points{coded_, positions_, records_};
  if (own.size() > options_.chunk_points && coded_.front().code == coded_.back().code)
    joiner_.packer().pack(points, own, cell, chunk.below);
  else
    chunk.top = open_node(points, own, cell, record_bytes_);
  chunk.top.cell = cell;
  return chunk;
}

}  // namespace stipple
