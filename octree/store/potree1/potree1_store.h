// Potree 1.x trees on disk.
#pragma once

#include <span>
#include <string>

#include "octree/store/potree1/format.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Versions 1.4 to 1.8, nodes of BIN, LAS and LAZ; see potree1/format.h.
class Potree1Store : public TreeStore {
 public:
  // `path` is the folder with cloud.js, or that. Reads it and the first piece of the hierarchy, of LAS and LAZ nodes
  // also a header. Metadata that state no number of points cost more: the whole hierarchy is read and every node
  // located. Throws Error naming file, place and expectation.
  explicit Potree1Store(const std::string& path);

  const TreeInfo& info() const override { return info_; }
  HierarchyPiece root_piece() const override { return metadata_.hierarchy; }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override;
  StoredNode locate(const StoredNode& node) const override;
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override;
  bool reads_parts() const override { return metadata_.encoding == potree1::Encoding::bin; }
  void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                 std::span<const std::size_t> attributes, PointBatch& batch) const override;

 private:
  HierarchyPiece read_hrc(const StoredNode& first) const;
  std::string path_of(const StoredNode& node, std::string_view extension) const;
  std::string node_path(const StoredNode& node) const;
  void decode(const StoredNode& node, std::span<const std::byte> rows, std::span<const std::size_t> attributes,
              PointBatch& batch) const;
  void take_grid(double scale);
  void take_las_schema();

  std::string folder_;
  potree1::Metadata metadata_;
  TreeInfo info_;
};

// Whether `path` is a folder with a cloud.js, or that cloud.js.
bool is_potree1(const std::string& path);

}  // namespace stipple
