// Entwine Point Tiles on disk.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "octree/store/ept/format.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Nodes of type laszip, binary and zstandard; see ept/format.h. Schema and grid of laszip nodes are those of their own
// files, of which the first is looked at; the schema in ept.json is PDAL's.
class EptStore : public TreeStore {
 public:
  // `path` is the folder with ept.json, ept-hierarchy and ept-data, or its ept.json. Reads that and the first page of
  // the hierarchy, of laszip nodes also a header, whatever the size of the tree. Throws Error naming file, place and
  // expectation.
  explicit EptStore(const std::string& path);

  const TreeInfo& info() const override { return info_; }
  HierarchyPiece root_piece() const override { return root_piece_; }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override;
  StoredNode locate(const StoredNode& node) const override;
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override;
  bool reads_parts() const override { return metadata_.data_type == ept::DataType::binary; }
  void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                 std::span<const std::size_t> attributes, PointBatch& batch) const override;

 private:
  HierarchyPiece read_page(const StoredNode& first) const;
  std::string node_path(const StoredNode& node) const;
  // The bytes of a node as rows.
  Buffer<std::byte> read_rows(const StoredNode& node, std::uint64_t offset, std::uint64_t bytes) const;
  void decode(const StoredNode& node, std::span<const std::byte> rows, std::span<const std::size_t> attributes,
              PointBatch& batch) const;
  void take_las_schema();

  std::string folder_;
  ept::Metadata metadata_;
  TreeInfo info_;
  HierarchyPiece root_piece_;
};

// Whether `path` is a folder with an ept.json, or that ept.json.
bool is_ept(const std::string& path);

}  // namespace stipple
