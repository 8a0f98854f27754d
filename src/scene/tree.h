// Trees and bushes: trunk, branches and clusters of leaves.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "src/scene/model.h"
#include "src/scene/random.h"

namespace stipple::scene {

enum class Species : std::uint8_t { broadleaf, birch, conifer, shrub };

struct Tree {
  Species species = Species::broadleaf;
  glm::dvec3 foot{0.0};
  double height = 10.0;       // metres
  double crown_radius = 3.0;  // metres; leaves stay within 1.4 times this of the axis
  std::uint32_t salt = 0;
};

// Square metres of bark and leaf, by which a tree's share of the points is settled.
double surface_area(const Tree& tree);

// A random point of the tree. Leaves stand in some hundred clusters with gaps between, so that one sees through.
ScenePoint sample_tree(const Tree& tree, PointRandom& random);

}  // namespace stipple::scene
