// Points of any source as an octree would hold them: on its grid, with its attributes. Then equal points are equal
// bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

// How one source's points become comparable to those of a tree.
struct Conversion {
  Grid from;
  Grid to;
  Schema schema;                                  // the attributes compared, as the tree has them
  std::vector<std::size_t> asked;                 // indices in the source's schema, for PointSource::read()
  std::vector<std::optional<std::size_t>> place;  // of each attribute of `schema` in `asked`; none: zeros
};

// `schema`: the attributes to compare. What the source lacks (by name and number of components) counts as zero.
Conversion conversion_of(const SourceInfo& source, const Grid& grid, const Schema& schema);

struct CanonicalBatch {
  std::uint64_t first = 0;
  Buffer<glm::ivec3> positions;
  std::vector<Column> columns;    // of Conversion::schema
  double largest_rounding = 0.0;  // of a coordinate, world units
};

// Rounds positions to the nearest grid step and values to the nearest that the type has. The same grid and type: no
// change at all.
void convert(const Conversion& conversion, const PointBatch& batch, CanonicalBatch& result);

}  // namespace stipple
