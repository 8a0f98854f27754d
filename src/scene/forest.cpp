#include "src/scene/forest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/scene/area_table.h"
#include "src/scene/noise.h"
#include "src/scene/random.h"
#include "src/scene/texture.h"
#include "src/scene/tree.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr double kForestSize = 400.0;  // metres, both ways
constexpr int kCells = 20;             // both ways
constexpr double kCell = kForestSize / kCells;
constexpr double kGroundWeight = 2.0;  // points on a square metre of ground against one of leaf

// What a part of the file covers: a square cell of ground, or one tree.
struct Canopy {
  bool is_tree;
  std::uint32_t number;  // of the tree, or of the cell: y * kCells + x
};

// A path winds through from west to east; metres to its middle.
double to_path(const glm::dvec2& at) {
  return std::abs(at.y - 200.0 - 38.0 * sin_turns(at.x / 310.0) - 11.0 * sin_turns(at.x / 97.0 + 0.3));
}

double ground_height(const glm::dvec2& at, std::uint32_t salt) {
  const double swell =
      22.0 * value_noise(at.x / 150.0, at.y / 150.0, salt) + 5.0 * value_noise(at.x / 40.0, at.y / 40.0, salt + 1);
  const double hummocks = 0.9 * fractal_noise(at.x / 7.0, at.y / 7.0, 4, salt + 2);
  return swell + hummocks * (0.15 + 0.85 * smooth_step(1.0, 3.5, to_path(at)));
}

class Forest : public SceneModel {
 public:
  Forest(std::uint64_t points, std::uint64_t seed)
      : points_(points), seed_(seed), salt_(static_cast<std::uint32_t>(mix64(seed ^ 0xF0E57ull))) {
    PointRandom random(seed, ~0ull);
    for (std::uint32_t cell = 0; cell < kCells * kCells; ++cell) {
      pieces_.push_back({false, cell});
      areas_.add(kGroundWeight * kCell * kCell);
      plant(cell, random);
    }
  }

  Grid grid() const override { return {{588000.0, 5405000.0, 430.0}, glm::dvec3(0.001)}; }
  WorldBox bounds() const override {
    const glm::dvec3 origin = grid().offset;
    constexpr double kOverhang = 12.0;
    return {origin - glm::dvec3(kOverhang, kOverhang, 1.0),
            origin + glm::dvec3(kForestSize + kOverhang, kForestSize + kOverhang, 80.0)};
  }

  ScenePoint point(std::uint64_t index) const override {
    PointRandom random(seed_, index);
    const double place = (static_cast<double>(index) + random.uniform()) / static_cast<double>(points_);
    const Canopy& piece = pieces_[areas_.pick(place)];
    return piece.is_tree ? sample_tree(trees_[piece.number], random) : sample_ground(piece.number, random);
  }

 private:
  // Big trees on a jittered lattice, bushes and saplings between; neither on the path.
  void plant(std::uint32_t cell, PointRandom& random) {
    constexpr int kStems = 3;  // both ways
    const glm::dvec2 corner = kCell * glm::dvec2(cell % kCells, cell / kCells);
    for (int i = 0; i < kStems * kStems; ++i) {
      const glm::dvec2 jitter(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9));
      const glm::dvec2 at = corner + kCell / kStems * (glm::dvec2(i % kStems, i / kStems) + jitter);
      // Stands of conifers among the broadleaved trees
      const double stand = fractal_noise(at.x / 90.0, at.y / 90.0, 2, salt_ + 20) + random.uniform(-0.12, 0.12);
      const double glade = fractal_noise(at.x / 60.0, at.y / 60.0, 2, salt_ + 30);
      if (glade > 0.72 || to_path(at) < 2.6) continue;
      if (stand > 0.54)
        add_tree(at, Species::conifer, random.uniform(14, 32), 0.15, random);
      else
        add_tree(at, stand < 0.36 ? Species::birch : Species::broadleaf, random.uniform(11, 26), 0.24, random);
    }
    for (int i = 0; i < 6; ++i) {
      const glm::dvec2 at = corner + kCell * glm::dvec2(random.uniform(), random.uniform());
      const double u = random.uniform();
      if (to_path(at) < 1.8) continue;
      if (u < 0.7)
        add_tree(at, Species::shrub, 0.5 + 2.2 * u, 0.6, random);
      else
        add_tree(at, u < 0.85 ? Species::conifer : Species::broadleaf, random.uniform(1.5, 6.0), 0.25, random);
    }
  }

  void add_tree(const glm::dvec2& at, Species species, double height, double slenderness, PointRandom& random) {
    Tree tree;
    tree.species = species;
    tree.foot = glm::dvec3(at, ground_height(at, salt_) - 0.05);
    tree.height = height;
    tree.crown_radius = slenderness * height * random.uniform(0.8, 1.2);
    tree.salt = static_cast<std::uint32_t>(random.bits());
    pieces_.push_back({true, static_cast<std::uint32_t>(trees_.size())});
    areas_.add(surface_area(tree));
    trees_.push_back(tree);
  }

  ScenePoint sample_ground(std::uint32_t cell, PointRandom& random) const {
    const glm::dvec2 at =
        kCell * (glm::dvec2(cell % kCells, cell / kCells) + glm::dvec2(random.uniform(), random.uniform()));
    ScenePoint point;
    point.position = glm::dvec3(at, ground_height(at, salt_));
    point.colour = forest_floor(at.x, at.y, salt_ + 40);
    const auto trodden =
        static_cast<float>(smooth_step(1.7, 0.9, to_path(at) + value_noise(at.x, at.y, salt_ + 60) - 0.5));
    const float gravel = fractal_noise(at.x * 5.0, at.y * 5.0, 4, salt_ + 50);
    point.colour = glm::mix(point.colour, glm::vec3(0.6f, 0.5f, 0.38f) * (0.5f + 0.8f * gravel), trodden);
    point.point_class = PointClass::ground;
    // Ferns and grass stand up to 60 cm where there is light
    const double lush = smooth_step(0.5, 0.7, fractal_noise(at.x / 9.0, at.y / 9.0, 3, salt_ + 70)) * (1 - trodden);
    if (random.uniform() < 0.45 * lush) {
      const float blade = value_noise(at.x * 6.0, at.y * 6.0, salt_ + 80);
      const double above = 0.6 * blade * random.uniform();
      point.position.z += above;
      point.colour = glm::vec3(0.3f, 0.44f, 0.15f) * (0.45f + 0.6f * blade + static_cast<float>(0.5 * above));
      if (above > 0.1) point.point_class = PointClass::low_vegetation;
    }
    // Sunlight reaches the floor in flecks
    const float fleck = fractal_noise(at.x / 3.0, at.y / 3.0, 3, salt_ + 90);
    point.colour *= 0.7f + 0.75f * static_cast<float>(smooth_step(0.52, 0.6, fleck));
    point.intensity = 0.15f + 0.7f * luminance(point.colour);
    return point;
  }

  std::uint64_t points_;
  std::uint64_t seed_;
  std::uint32_t salt_;
  std::vector<Canopy> pieces_;
  AreaTable areas_;
  std::vector<Tree> trees_;
};

}  // namespace

std::unique_ptr<SceneModel> make_forest(std::uint64_t points, std::uint64_t seed) {
  return std::make_unique<Forest>(points, seed);
}

}  // namespace stipple::scene
