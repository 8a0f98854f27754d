// Finds out what an octree on disk is by its content and opens it.
#pragma once

#include <memory>
#include <string>

#include "octree/store/tree_store.h"

namespace stipple {

// Whether open_tree() knows what is there, whole or damaged.
bool is_tree(const std::string& path);

// Throws Error naming the file, the place and what was expected there; also when is_tree() says no.
std::unique_ptr<TreeStore> open_tree(const std::string& path);

}  // namespace stipple
