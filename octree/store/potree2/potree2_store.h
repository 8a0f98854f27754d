// Potree 2.0 trees on disk, ours and PotreeConverter's, and our kd trees, which have the same files (kd_boxes.h).
#pragma once

#include <memory>
#include <span>
#include <string>

#include "octree/read/input_file.h"
#include "octree/store/potree2/format.h"
#include "octree/store/potree2/hierarchy.h"
#include "octree/store/potree2/sidecar.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Encodings DEFAULT, UNCOMPRESSED and BROTLI; see potree2/format.h. Details and a promise of distance come from our
// sidecar, where there is one that belongs to the tree.
class Potree2Store : public TreeStore {
 public:
  // `path` is the folder with metadata.json (kdtree.json), hierarchy.bin and octree.bin, or that JSON file. Reads the
  // metadata and the first piece of the hierarchy, whatever the size of the tree. Throws Error naming file, place and
  // expectation.
  explicit Potree2Store(const std::string& path);

  const TreeInfo& info() const override { return info_; }
  HierarchyPiece root_piece() const override { return root_piece_; }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override;
  StoredNode locate(const StoredNode& node) const override { return node; }
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override;
  bool reads_parts() const override { return metadata_.encoding == potree2::Encoding::uncompressed; }
  void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                 std::span<const std::size_t> attributes, PointBatch& batch) const override;
  NodeDetails read_details(const StoredNode& node) const override;

 private:
  void take_boxes(const std::string& folder);
  HierarchyPiece read_piece_at(std::uint64_t offset, std::uint64_t bytes, const StoredNode& first) const;

  potree2::Metadata metadata_;
  InputFile hierarchy_;
  InputFile points_;
  potree2::PointFile point_file_;
  TreeInfo info_;
  std::unique_ptr<potree2::Sidecar> sidecar_;  // null: there is none
  HierarchyPiece root_piece_;
};

// Whether `path` is a folder with a metadata.json, or a kdtree.json, beside a hierarchy.bin or an octree.bin, or that
// JSON file.
bool is_potree2(const std::string& path);

}  // namespace stipple
