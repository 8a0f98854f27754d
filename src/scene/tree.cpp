#include "src/scene/tree.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/texture.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

struct Habit {
  std::uint32_t branches;
  std::uint32_t clusters_per_branch;
  double crown_base;  // share of the height
  double rise;        // of a branch, in shares of its length
  double trunk_share;
  double branch_share;
  glm::vec3 leaf;
  glm::vec3 other_leaf;  // trees vary between the two
  glm::vec3 bark;
};

const Habit& habit_of(Species species) {
  static constexpr Habit kHabits[] = {
      {34, 11, 0.25, 0.55, 0.05, 0.08, {0.23f, 0.37f, 0.11f}, {0.4f, 0.45f, 0.14f}, {0.34f, 0.29f, 0.24f}},
      {28, 9, 0.3, 0.8, 0.07, 0.08, {0.36f, 0.47f, 0.17f}, {0.55f, 0.5f, 0.18f}, {0.78f, 0.77f, 0.73f}},
      {64, 6, 0.16, -0.28, 0.06, 0.08, {0.11f, 0.23f, 0.12f}, {0.2f, 0.3f, 0.15f}, {0.36f, 0.26f, 0.19f}},
      {14, 7, 0.04, 0.6, 0.01, 0.07, {0.27f, 0.37f, 0.14f}, {0.42f, 0.4f, 0.18f}, {0.3f, 0.25f, 0.2f}},
  };
  return kHabits[static_cast<std::size_t>(species)];
}

// Outline of the crown: radius at height `t` of the crown, both as shares.
double outline(Species species, double t) {
  if (species == Species::conifer) return 0.06 + 0.94 * (1 - t);
  return std::sqrt(std::max(4 * t * (1 - t), 0.0)) * (1.15 - 0.3 * t);
}

struct Branch {
  glm::dvec3 start;
  glm::dvec3 end;
};

Branch branch_of(const Tree& tree, const Habit& habit, std::uint32_t b) {
  const double t = (b + static_cast<double>(cell_value(b, 1, tree.salt))) / habit.branches;
  // Successive branches are a golden angle apart
  const double turns = 0.381966 * b + 0.12 * cell_value(b, 2, tree.salt);
  const double length = tree.crown_radius * outline(tree.species, t) * (0.72 + 0.36 * cell_value(b, 3, tree.salt));
  const double end_height = tree.height * (habit.crown_base + (1 - habit.crown_base) * t);
  const double start_height = std::clamp(end_height - habit.rise * length, 0.1 * tree.height, 0.97 * tree.height);
  const glm::dvec2 out = length * direction_from_turns(turns);
  return {tree.foot + glm::dvec3(0, 0, start_height),
          tree.foot + glm::dvec3(out, habit.rise < 0 ? start_height + habit.rise * length : end_height)};
}

std::uint32_t pick_branch(const Tree& tree, const Habit& habit, PointRandom& random) {
  // A conifer's upper branches are shorter and hold less
  const double u = random.uniform();
  const double share = tree.species == Species::conifer ? 1 - std::sqrt(1 - u) : u;
  return std::min(static_cast<std::uint32_t>(share * habit.branches), habit.branches - 1);
}

PointClass vegetation_class(const Tree& tree) {
  if (tree.height > 5) return PointClass::high_vegetation;
  return tree.height > 2 ? PointClass::medium_vegetation : PointClass::low_vegetation;
}

ScenePoint sample_trunk(const Tree& tree, const Habit& habit, PointRandom& random) {
  // Wider, so more often, below
  const double t = 1 - std::sqrt(1 - 0.97 * random.uniform());
  const double turns = random.uniform();
  const glm::dvec2 out = direction_from_turns(turns);
  const double flare = 1 + 0.8 * std::max(0.0, 1 - t * tree.height / 0.6);
  const double radius = 0.018 * tree.height * (1 - 0.85 * t) * flare;
  ScenePoint point;
  point.position = tree.foot + glm::dvec3(radius * out, t * tree.height);
  const float furrow = fractal_noise(turns * 14, point.position.z * 1.3, 4, tree.salt);
  point.colour = habit.bark * (0.45f + 0.8f * furrow) * sunlight({out.x, out.y, 0});
  // Birch bark is white with dark cross marks
  if (tree.species == Species::birch && value_noise(turns * 3, point.position.z * 9, tree.salt + 5) > 0.76f)
    point.colour *= 0.3f;
  return point;
}

ScenePoint sample_branch(const Tree& tree, const Habit& habit, PointRandom& random) {
  const Branch branch = branch_of(tree, habit, pick_branch(tree, habit, random));
  const double s = random.uniform();
  const double thickness = 0.0045 * tree.height * (1 - 0.8 * s);
  ScenePoint point;
  point.position = glm::mix(branch.start, branch.end, s) +
                   thickness * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const float mottle = value_noise(s * 12, point.position.z * 3, tree.salt + 9);
  point.colour = glm::mix(habit.bark, glm::vec3(0.3f, 0.25f, 0.2f), 0.6f) * (0.45f + 0.4f * mottle);
  return point;
}

ScenePoint sample_leaf(const Tree& tree, const Habit& habit, PointRandom& random) {
  const std::uint32_t b = pick_branch(tree, habit, random);
  const std::uint32_t c = random.below(habit.clusters_per_branch);
  const Branch branch = branch_of(tree, habit, b);
  const std::uint32_t salt = hash(b, c, tree.salt + 17);

  // Find the middle of the cluster, along the branch and to one side of it
  const double s = 0.3 + 0.7 * (c + static_cast<double>(cell_value(0, 0, salt))) / habit.clusters_per_branch;
  const glm::dvec3 along = branch.end - branch.start;
  const double side = (cell_value(1, 0, salt) - 0.5) * 0.55 * s;
  const glm::dvec3 across(-along.y, along.x, 0.0);
  const double spread = 0.11 * tree.crown_radius;
  glm::dvec3 middle = branch.start + s * along + side * across;
  middle.z += 1.5 * spread * (cell_value(2, 0, salt) - 0.5);

  // Find a leaf of its tilted, slightly curved spray
  constexpr std::uint32_t kLeaves = 26;
  const std::uint32_t leaf = random.below(kLeaves);
  const double radius = spread * (0.7 + 0.7 * cell_value(3, 0, salt)) * std::sqrt(cell_value(leaf, 8, salt));
  const glm::dvec2 offset = radius * direction_from_turns(cell_value(leaf, 9, salt)) +
                            0.17 * spread * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
  const glm::dvec2 tilt(1.2 * (cell_value(4, 0, salt) - 0.5), 1.2 * (cell_value(5, 0, salt) - 0.5));
  ScenePoint point;
  point.position = middle + glm::dvec3(offset, glm::dot(offset, tilt) - 0.6 * radius * radius / spread);
  point.position.z += 0.35 * spread * (cell_value(leaf, 10, salt) - 0.5);

  // Shade: bright towards the sun, dark inside and below
  const glm::vec3 out = glm::vec3(point.position - tree.foot - glm::dvec3(0, 0, 0.55 * tree.height)) /
                        static_cast<float>(tree.crown_radius + 0.25 * tree.height);
  const float light =
      0.62f + 0.5f * glm::dot(out, glm::vec3(-0.35f, -0.42f, 0.75f)) + 0.25f * (glm::length(out) - 0.6f);
  const float leaves = cell_value(leaf, 11, salt);
  const float tone = 0.75f + 0.3f * unit(salt) + 0.45f * (leaves - 0.5f);
  const glm::vec3 hue =
      glm::mix(habit.leaf, habit.other_leaf, 0.75f * cell_value(7, 7, tree.salt) + 0.25f * unit(salt));
  point.colour = 1.35f * hue * std::max(light, 0.22f) * tone;
  return point;
}

}  // namespace

double surface_area(const Tree& tree) {
  return 3.2 * tree.crown_radius * tree.height + 0.06 * tree.height * tree.height;
}

ScenePoint sample_tree(const Tree& tree, PointRandom& random) {
  const Habit& habit = habit_of(tree.species);
  const double part = random.uniform();
  ScenePoint point;
  if (part < habit.trunk_share)
    point = sample_trunk(tree, habit, random);
  else if (part < habit.trunk_share + habit.branch_share)
    point = sample_branch(tree, habit, random);
  else
    point = sample_leaf(tree, habit, random);
  point.intensity = 0.15f + 0.7f * point.colour.g;
  point.point_class = vegetation_class(tree);
  return point;
}

}  // namespace stipple::scene
