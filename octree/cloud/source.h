// Where points come from: files, generated scenes.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/core/buffer.h"

namespace stipple {

struct SourceInfo {
  std::string path;      // as given by the user; the scene's name for generated ones
  std::string format;    // "LAS"
  std::string version;   // "1.4"
  std::string encoding;  // "point format 7, 36 bytes a point"
  std::uint64_t point_count = 0;
  std::uint64_t dropped_points = 0;  // of the file, not in point_count: those without a finite position
  Grid grid;
  Schema schema;           // everything a point carries beside its position
  WorldBox stated_bounds;  // what the header says, or what opening found out; empty when neither says anything.
                           // Headers lie: see Cloud::bounds
  std::vector<std::string> warnings;  // oddities that lose no point, in sentences
};

// Points [first, first + positions.size()) of a source.
struct PointBatch {
  std::uint64_t first = 0;
  Buffer<glm::ivec3> positions;  // on the source's grid
  std::vector<Column> columns;   // the attributes asked for, in the order asked for
};

using BatchConsumer = std::function<void(const PointBatch&)>;

class PointSource {
 public:
  virtual ~PointSource() = default;
  PointSource() = default;
  PointSource(const PointSource&) = delete;
  PointSource& operator=(const PointSource&) = delete;

  virtual const SourceInfo& info() const = 0;

  // Decodes every point once, on all cores. `attributes` are indices into info().schema; what is not asked for is not
  // decoded. `consume` is called from several threads at once with disjoint batches in any order, and must not keep
  // the batch. Throws Error when the data break off or contradict themselves; then not all batches were delivered.
  virtual void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const = 0;
};

}  // namespace stipple
