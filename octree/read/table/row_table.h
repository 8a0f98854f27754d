// Rows of a fixed number of bytes, in a file or in memory.
#pragma once

#include <functional>
#include <vector>

#include "octree/read/table/point_table.h"

namespace stipple {

// A field's place in its rows.
struct FieldPlace {
  TableField field;
  std::size_t part = 0;    // index into the parts
  std::size_t offset = 0;  // bytes from the row's begin
};

// A stretch of rows. A table has one, or several whose rows belong together number by number.
struct RowPart {
  std::uint64_t begin = 0;  // byte offset of the first row
  std::size_t stride = 0;   // bytes a row
};

// Gives `size` bytes from `offset` on; in `scratch` unless they are in memory anyway. Called from several threads.
using ByteReader = std::function<const std::byte*(std::uint64_t offset, std::size_t size, Buffer<std::byte>& scratch)>;

class RowTable : public PointTable {
 public:
  // All rows must be there: the caller has held their number against the size of the file. `swap`: the numbers' bytes
  // stand in the order that is not this machine's.
  RowTable(ByteReader bytes, std::vector<RowPart> parts, std::vector<FieldPlace> fields, std::uint64_t rows, bool swap);

  const std::vector<TableField>& fields() const override { return fields_; }
  std::size_t blocks() const override;
  std::size_t rows(std::size_t block) const override;
  void decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
              Buffer<std::byte>& scratch) const override;

 private:
  ByteReader bytes_;
  std::vector<RowPart> parts_;
  std::vector<FieldPlace> places_;
  std::vector<TableField> fields_;
  std::uint64_t rows_;
  std::size_t block_rows_;
  bool swap_;
};

}  // namespace stipple
