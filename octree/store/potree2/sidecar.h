// What we know of a tree and Potree 2.0 has no room for, in a file beside the others: tight boxes, clusters, box-count
// profiles, how inner nodes were sampled. The tree is whole without it.
//
// stipple.bin, little-endian, packed:
//
//   offset  bytes  header
//        0      8  "stipple\0"
//        8      4  version, u32: kSidecarVersion
//       12      4  sampling, u32: 0 poisson, 1 random
//       16      8  fraction, f64: points of an inner node are at least this times the node's spacing apart
//       24      8  points, u64: of the tree
//       32      8  octree.bin, u64: its bytes
//       40      8  nodes, u64: those with points
//       48      8  clusters, u64
//       56      8  seed, u64
//       64         clusters of 120 bytes, those of a node together, nodes in the order of octree.bin
//                  first u32 (point of the node), count u32, box min 3 x i32, box max 3 x i32 (the tree's grid, both
//                  corners inside), profile 22 x u32
//                  nodes of 140 bytes, in the order of octree.bin
//                  byte offset u64 (in octree.bin), first cluster u64, points u32, clusters u32, level u32, box 6 x
//                  i32, profile 22 x u32
//
// A profile counts the occupied cells of edge (root edge) / 2^level for levels 0 to 21: octree/tree/octree.h.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octree/core/buffer.h"
#include "octree/read/input_file.h"
#include "octree/store/potree2/writer_file.h"
#include "octree/tree/octree.h"

namespace stipple::potree2 {

inline constexpr const char* kSidecarName = "stipple.bin";
inline constexpr std::uint32_t kSidecarVersion = 1;

struct SidecarHeader {
  std::uint32_t sampling = 0;  // 0 poisson, 1 random
  double fraction = 0.0;       // of the spacing of its level, the least distance between points of an inner node
  std::uint64_t points = 0;
  std::uint64_t octree_bytes = 0;
  std::uint64_t nodes = 0;
  std::uint64_t clusters = 0;
  std::uint64_t seed = 0;
};

struct SidecarNode {
  std::uint64_t byte_offset = 0;  // of its points in octree.bin
  std::uint64_t first_cluster = 0;
  std::uint32_t points = 0;
  std::uint32_t clusters = 0;
  std::uint32_t level = 0;
  GridBox box;
  BoxCounts profile;
};

// An opened sidecar. Holds the header alone: the rest is read when asked for. All functions may be called from several
// threads at once, and throw Error when the file breaks off or contradicts itself.
class Sidecar {
 public:
  explicit Sidecar(const std::string& path);  // throws Error when it is none, or of another version or size

  const SidecarHeader& header() const { return header_; }
  SidecarNode node(std::uint64_t index) const;
  // The node whose points begin at `byte_offset` of octree.bin.
  std::optional<SidecarNode> find(std::uint64_t byte_offset) const;
  std::vector<Cluster> clusters(const SidecarNode& node) const;
  // What finding the node and its clusters reads, at most.
  std::uint64_t bytes_of(const SidecarNode& node) const;

 private:
  InputFile file_;
  SidecarHeader header_;
};

// The sidecar in `folder` if there is one and it belongs to the tree of `points` points and `octree_bytes` bytes. Null
// when there is none; with a sentence in `warnings` when there is one that cannot be used.
std::unique_ptr<Sidecar> read_sidecar(const std::string& folder, std::uint64_t points, std::uint64_t octree_bytes,
                                      std::vector<std::string>& warnings);

class SidecarWriter {
 public:
  explicit SidecarWriter(const std::string& folder);

  // The next node in the order of octree.bin; its first_cluster is set here.
  void add(SidecarNode node, std::span<const Cluster> clusters);
  // Fills in the numbers of nodes and clusters; returns the bytes of the file.
  std::uint64_t finish(SidecarHeader header);

 private:
  void flush_clusters();
  void flush_nodes();

  WriterFile file_;
  WriterFile spool_;  // nodes wait here until all clusters are written
  Buffer<std::byte> cluster_buffer_;
  Buffer<std::byte> node_buffer_;
  std::uint64_t clusters_ = 0;
  std::uint64_t nodes_ = 0;
  std::uint64_t clusters_end_;  // bytes written
  std::uint64_t nodes_end_ = 0;
};

}  // namespace stipple::potree2
