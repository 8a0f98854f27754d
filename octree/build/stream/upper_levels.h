// The levels above the chunks, joined as chunks come in Morton order: a cell is closed as soon as the first chunk
// behind it comes, so that no more is open than one path of the tree and its children.
#pragma once

#include <vector>

#include "octree/build/stream/chunk_builder.h"

namespace stipple {

class UpperLevels {
 public:
  UpperLevels(const StreamOptions& options, const CubeFrame& frame, std::size_t record_bytes)
      : joiner_(options, frame, record_bytes), record_bytes_(record_bytes) {}

  // The next chunk's own node. Appends to `packed` the nodes that are complete now, children before parents.
  void add(OpenNode&& node, potree2::PackedNodes& packed);
  // After the last chunk: the rest, the root last.
  void finish(potree2::PackedNodes& packed);

 private:
  struct OpenCell {
    CellId cell;
    std::vector<OpenNode> children;
  };

  void close_last(potree2::PackedNodes& packed);

  NodeJoiner joiner_;
  std::size_t record_bytes_;
  std::vector<OpenCell> path_;  // path_[level]
  std::vector<OpenNode> root_;  // when it is done, one
};

}  // namespace stipple
