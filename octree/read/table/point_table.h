// What PLY, PCD, OBJ and text have in common: rows of named numbers, a point each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/core/buffer.h"

namespace stipple {

// Named as in the file.
struct TableField {
  std::string name;
  ScalarType type = ScalarType::f32;
  int components = 1;
};

// Rows in blocks that can be decoded one by one, by several threads at once. What the numbers mean is TableSource's.
class PointTable {
 public:
  virtual ~PointTable() = default;
  PointTable() = default;
  PointTable(const PointTable&) = delete;
  PointTable& operator=(const PointTable&) = delete;

  virtual const std::vector<TableField>& fields() const = 0;

  virtual std::size_t blocks() const = 0;
  virtual std::size_t rows(std::size_t block) const = 0;

  // Fills columns[i], sized for the block and of the field's type, with fields()[fields[i]] of the block's rows.
  // `scratch` is memory to reuse from call to call. Throws Error naming file and place.
  virtual void decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
                      Buffer<std::byte>& scratch) const = 0;
};

}  // namespace stipple
