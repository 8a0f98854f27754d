#include "octree/store/open_tree.h"

#include <fmt/format.h>

#include "octree/core/error.h"
#include "octree/store/copc/copc_store.h"
#include "octree/store/ept/ept_store.h"
#include "octree/store/potree1/potree1_store.h"
#include "octree/store/potree2/potree2_store.h"

namespace stipple {

bool is_tree(const std::string& path) {
  return is_potree2(path) || is_ept(path) || is_potree1(path) || is_copc(path);
}

std::unique_ptr<TreeStore> open_tree(const std::string& path) {
  if (is_potree2(path)) return std::make_unique<Potree2Store>(path);
  if (is_potree1(path)) return std::make_unique<Potree1Store>(path);
  if (is_ept(path)) return std::make_unique<EptStore>(path);
  if (is_copc(path)) return std::make_unique<CopcStore>(path);
  throw Error(
      fmt::format("{}: is no octree that is read: a folder with metadata.json, hierarchy.bin and octree.bin "
                  "(Potree 2.0), cloud.js (Potree 1) or ept.json (EPT), or a COPC file. Build one with `stipple "
                  "build`, or check the path.",
                  path));
}

}  // namespace stipple
