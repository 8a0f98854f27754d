// The octree below one cell, built by one thread from the leaves up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octree/build/stream/node_packer.h"
#include "octree/build/stream/options.h"
#include "octree/build/stream/sampler.h"
#include "octree/store/potree2/writer.h"

namespace stipple {

// The points of a cell's own node as long as the node above has not chosen among them; with copies of their records.
struct OpenNode {
  CellId cell;
  Buffer<CodedPoint> coded;  // ascending; ids are indices in `records`
  Buffer<glm::ivec3> positions;
  Buffer<std::byte> records;

  SortedPoints points() const { return {coded, positions, records.data()}; }
};

struct BuiltChunk {
  potree2::PackedNodes below;  // all nodes but the cell's own, children before parents
  OpenNode top;
};

// Lets a node choose from its children, whose points are in `offered`; packs what it leaves them and returns what it
// takes. Lists hold ascending indices; children in Morton order.
class NodeJoiner {
 public:
  struct Child {
    CellId cell;
    Buffer<std::uint32_t> offered;
  };

  NodeJoiner(const StreamOptions& options, const CubeFrame& frame, std::size_t record_bytes)
      : sampler_(options.sampling, frame), packer_(options, record_bytes) {}

  Buffer<std::uint32_t> join(const SortedPoints& points, int level, std::span<const Child> children,
                             potree2::PackedNodes& packed);
  NodePacker& packer() { return packer_; }

 private:
  Sampler sampler_;
  NodePacker packer_;
  Buffer<std::uint32_t> candidates_;
  Buffer<std::uint8_t> taken_;
  Buffer<std::uint32_t> left_;
};

// Copies the points of `own` out, to outlive the chunk.
OpenNode open_node(const SortedPoints& points, std::span<const std::uint32_t> own, const CellId& cell,
                   std::size_t record_bytes);

// Reused from chunk to chunk; one a thread.
class ChunkBuilder {
 public:
  ChunkBuilder(const StreamOptions& options, const CubeFrame& frame, std::size_t record_bytes);

  // `records` are all points of the cell, in any order; the result does not depend on it. A cell no larger than
  // leaf_capacity, or all of whose points have one code, is a leaf. A leaf of more than chunk_points, which is one heap
  // of points at one place, keeps them all: nothing rises from it.
  BuiltChunk build(const CellId& cell, std::span<const std::byte> records);

 private:
  void sort(const CellId& cell);
  void order_equals();
  Buffer<std::uint32_t> grow(const CellId& cell, std::uint32_t first, std::uint32_t last, potree2::PackedNodes& packed);

  const StreamOptions& options_;
  std::size_t record_bytes_;
  Quantizer quantizer_;
  NodeJoiner joiner_;
  const std::byte* records_ = nullptr;
  Buffer<CodedPoint> coded_;
  Buffer<CodedPoint> scratch_;
  Buffer<glm::ivec3> positions_;
};

}  // namespace stipple
