// A whole cloud in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/cloud/source.h"

namespace stipple {

// Point i of the source is positions[i] and element i of each column: the stable id of a point is its index here.
struct Cloud {
  SourceInfo info;
  Buffer<glm::ivec3> positions;
  std::vector<Column> columns;
  GridBox bounds;  // of the points themselves, not of the header

  std::size_t size() const { return positions.size(); }
  const Column* find(std::string_view name) const;
};

// Reads positions and the named attributes on all cores. Names the source lacks are left out: ask find(). Throws Error
// when the source does, or when it has more points than 32-bit ids can tell apart (2^32 - 2).
Cloud load_cloud(const PointSource& source, const std::vector<std::string>& attributes);

// Told, by several threads at once, that points [first, first + count) are there.
using PointsArrived = std::function<void(std::uint64_t first, std::size_t count)>;
// The same into `cloud`, which has its size before the first points arrive and its bounds after the last. What
// `arrived` throws ends the reading.
void load_cloud(const PointSource& source, const std::vector<std::string>& attributes, Cloud& cloud,
                const PointsArrived& arrived);

}  // namespace stipple
