// Through elements of a binary PLY file whose rows have lists, and so differ in length.
#pragma once

#include <cstdint>
#include <vector>

#include "octree/core/buffer.h"
#include "octree/read/input_file.h"
#include "octree/read/ply/ply_header.h"
#include "octree/read/table/point_table.h"

namespace stipple::ply {

// Rows whose places are noted, one every so many.
struct WalkedRows {
  std::uint64_t end = 0;             // byte behind the last row
  std::vector<std::uint64_t> marks;  // byte offsets of rows 0, every, 2 * every, ...; and `end`
};

// From `begin` over all rows of the element. Throws Error, naming the byte, when the file ends before, or when a list
// has a negative length.
WalkedRows walk_rows(const InputFile& file, const Element& element, std::uint64_t begin, bool swap,
                     std::uint64_t every);

// The vertices of a file whose vertices have lists.
class ListTable : public PointTable {
 public:
  // `file` must outlive the table.
  ListTable(const InputFile& file, const Element& element, std::uint64_t begin, bool swap);

  const std::vector<TableField>& fields() const override { return fields_; }
  std::size_t blocks() const override { return rows_.marks.size() - 1; }
  std::size_t rows(std::size_t block) const override;
  void decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
              Buffer<std::byte>& scratch) const override;

 private:
  const InputFile& file_;
  Element element_;
  bool swap_;
  WalkedRows rows_;
  std::vector<TableField> fields_;  // the properties that are no lists, in their order
};

}  // namespace stipple::ply
