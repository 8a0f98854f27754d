// Cloud-optimized point clouds: a LAZ file whose chunks are the nodes of an octree.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "octree/read/input_file.h"
#include "octree/read/las/las_header.h"
#include "octree/read/laz/laz_format.h"
#include "octree/store/copc/format.h"
#include "octree/store/tree_store.h"

namespace stipple {

// COPC 1.0; see copc/format.h. A node is read as a whole; attributes that are not asked for are not decoded.
class CopcStore : public TreeStore {
 public:
  // Reads the header, the variable length records and the first page of the hierarchy, whatever the size of the tree.
  // Throws Error naming the file, the byte and what was expected there.
  explicit CopcStore(const std::string& path);

  const TreeInfo& info() const override { return info_; }
  HierarchyPiece root_piece() const override { return root_piece_; }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override;
  StoredNode locate(const StoredNode& node) const override { return node; }
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override;
  bool reads_parts() const override { return false; }

 private:
  HierarchyPiece read_page(std::uint64_t offset, std::uint64_t bytes, const StoredNode& first) const;

  InputFile file_;
  las::Header header_;
  laz::Format format_;
  TreeInfo info_;
  HierarchyPiece root_piece_;
};

// Whether `path` is a file that begins as COPC does: LAS, and the first record behind its header is COPC's.
bool is_copc(const std::string& path);

}  // namespace stipple
