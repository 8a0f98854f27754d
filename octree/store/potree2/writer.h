// Writing a Potree 2.0 tree, with its sidecar, into a folder: points as they come, hierarchy and metadata at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "octree/core/buffer.h"
#include "octree/store/potree2/format.h"
#include "octree/store/potree2/sidecar.h"
#include "octree/store/potree2/writer_file.h"
#include "octree/store/potree2/writer_hierarchy.h"
#include "octree/tree/octree.h"

namespace stipple::potree2 {

// Nodes whose points stand one after the other, in the order of `nodes`; none is without points.
struct PackedNodes {
  struct PackedNode {
    int level = 0;
    std::uint64_t code = 0;  // Morton code, lowest of the cell
    std::uint32_t points = 0;
    std::uint32_t clusters = 0;
    std::uint64_t bytes = 0;  // of PackedNodes::bytes
    GridBox box;              // tight
    BoxCounts profile;
  };
  std::vector<PackedNode> nodes;
  std::vector<Cluster> clusters;  // node after node; `first` counts from the node's first point
  Buffer<std::byte> bytes;        // records, or what encode_brotli() made of them

  void clear() {
    nodes.clear();
    clusters.clear();
    bytes.clear();
  }
};

class TreeWriter {
 public:
  // `folder` exists and is empty. Throws Error when files cannot be created there.
  explicit TreeWriter(const std::string& folder);

  // The place of octree.bin while it is written.
  const std::string& points_path() const { return points_.path(); }

  // Gives the nodes the next place in octree.bin and returns it. The order of calls is that of the file. One thread.
  std::uint64_t place(const PackedNodes& packed);
  // Writes bytes to the place that their nodes were given. From several threads at once.
  void write(std::uint64_t place, std::span<const std::byte> bytes);

  // Completes all files and brings them to the disk. Sets what the hierarchy says in `metadata`. The cloud of no point
  // gets a root without points.
  void finish(Metadata& metadata, SidecarHeader sidecar);

  const std::vector<NodeEntry>& nodes() const { return nodes_; }
  std::uint64_t bytes_written() const { return bytes_written_; }  // all files, after finish()

 private:
  std::string folder_;
  WriterFile points_;
  SidecarWriter sidecar_;
  std::vector<NodeEntry> nodes_;
  std::uint64_t end_ = 0;
  std::uint64_t bytes_written_ = 0;
};

}  // namespace stipple::potree2
