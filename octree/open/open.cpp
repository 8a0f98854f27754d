#include "octree/open/open.h"

#include "octree/read/open.h"
#include "octree/store/open_tree.h"
#include "octree/store/tree_source.h"

namespace stipple {

std::unique_ptr<PointSource> open_source(const std::string& path) {
  if (is_tree(path)) return std::make_unique<TreeSource>(open_tree(path));
  return open_file(path);
}

}  // namespace stipple
