// A tree over a plane and views of it from above.
#pragma once

#include <cmath>

#include "render/frame/camera.h"
#include "tests/octree/node_files.h"

namespace stipple::test {

// A tree over a plane: four children a node, 60 points in each of its 5,461 nodes.
inline TreeFiles plane_tree(int depth = 6) {
  TreeFiles tree;
  std::vector<std::string> level{"r"};
  for (int d = 0; d <= depth; ++d) {
    std::vector<std::string> next;
    for (const std::string& name : level) {
      tree.nodes[name] = TreeFiles::points_in(name);
      for (const char child : {'0', '2', '4', '6'}) next.push_back(name + child);
    }
    level = next;
  }
  return tree;
}

// Straight down on a square whose edge is `share` of the cube's, around a place given in shares of its x and y, from so
// far above that height hardly matters.
inline View from_above(const RootCube& cube, double share, const glm::dvec2& place) {
  const double height = 100.0 * cube.edge;
  const glm::dvec3 target = cube.min + cube.edge * glm::dvec3(place, 0.0);
  Camera camera{.eye = target + glm::dvec3(0, 0, height), .target = target, .up = {0, 1, 0}};
  camera.fov_deg = glm::degrees(2.0 * std::atan(0.5 * share * cube.edge / height));
  return make_view(camera, {128, 128}, 1e-3 * cube.edge);
}

// Of plane_tree().
inline const RootCube kPlaneCube{{100.0, 200.0, 300.0}, 1024.0};
inline constexpr glm::dvec2 kPlace{0.437, 0.613};

}  // namespace stipple::test
