// Where everything stands in the "city" scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "src/scene/area_table.h"
#include "src/scene/tree.h"

namespace stipple::scene {

constexpr double kCitySize = 1000.0;  // metres, both ways
constexpr double kBlockX = 100.0;     // from one road's centre line to the next
constexpr double kBlockY = 1000.0 / 12.0;
constexpr double kCarriageway = 7.0;  // half the width of a road
constexpr double kPavement = 4.0;     // width of the pavement beside it
constexpr double kKerb = 0.12;        // height of everything else over the road

// The lie of the land, 0 to about 16 m.
double city_ground(double x, double y, std::uint32_t salt);

// What a surface is made of, and so how its points are placed and coloured. Those up to `park` lie on the ground.
enum class Material : std::uint8_t {
  road,
  pavement,
  yard,
  park,
  kerb,
  facade,
  plinth,
  parapet,
  flat_roof,
  roof_unit,
  gable_roof,
  gable_wall,
  floor,
  ceiling,
  partition,
  car_body,
  car_cabin,
  lamp_post,
  tree
};

enum class WallKind : std::uint8_t { brick, plaster, panel, curtain };

struct Building {
  WallKind wall = WallKind::brick;
  glm::vec3 colour{0.0f};
  glm::vec3 roof_colour{0.0f};
  double storey_height = 3.0;
  double bay_width = 3.0;
  double window_width = 0.5;   // share of the bay
  double window_height = 0.5;  // share of the storey
  double floor_z = 0.0;        // of the lowest storey
  std::uint32_t salt = 0;
};

// A parallelogram; the outside is where cross(edge_u, edge_v) points. For Material::tree only `owner` counts.
// Material::gable_wall is the triangle between the origin and the ends of both edges.
struct Surface {
  Material material = Material::road;
  std::uint32_t owner = 0;  // index of the building or tree; any number that tells cars apart
  glm::dvec3 origin{0.0};
  glm::dvec3 edge_u{0.0};
  glm::dvec3 edge_v{0.0};
};

struct CityPlan {
  std::vector<Surface> surfaces;  // block by block
  AreaTable areas;                // of the surfaces
  std::vector<Building> buildings;
  std::vector<Tree> trees;
  std::uint32_t salt = 0;
};

CityPlan plan_city(std::uint64_t seed);

// A window of a facade, in metres within its bay and storey.
struct Window {
  glm::dvec2 low;
  glm::dvec2 high;
  static constexpr double kDepth = 0.18;  // the pane stands behind the wall

  double reveal_area() const { return 2 * kDepth * (high.x - low.x + high.y - low.y); }
};

// Bays and storeys of a facade surface and the size of each.
struct FacadeGrid {
  int bays;
  int storeys;
  double bay_width;
  double storey_height;
  Window window;

  double cell_area() const { return bay_width * storey_height + window.reveal_area(); }
};
FacadeGrid facade_grid(const Building& building, const Surface& facade);

}  // namespace stipple::scene
