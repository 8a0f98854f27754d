// Points of a node as rows, one a point: EPT's binary nodes and Potree 1's BIN files are such.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/source.h"

namespace stipple {

// An attribute and where its components stand in a row.
struct RowField {
  Attribute attribute;
  std::vector<std::size_t> offsets;  // bytes from the start of the row, one a component
  bool widened = false;              // the row has uint8 where the attribute is uint16: the values stay

  bool operator==(const RowField&) const = default;
};

struct RowLayout {
  std::size_t bytes = 0;  // of a row
  std::vector<RowField> fields;

  Schema schema() const;
};

// Fills batch.columns with the attributes asked for (indices into layout.fields) of all rows.
void decode_columns(std::span<const std::byte> rows, const RowLayout& layout, std::span<const std::size_t> attributes,
                    PointBatch& batch);

}  // namespace stipple
