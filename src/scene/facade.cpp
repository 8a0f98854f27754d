#include "src/scene/facade.h"

#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/texture.h"

namespace stipple::scene {
namespace {

constexpr double kFrame = 0.07;  // width of a window frame

struct Cell {
  int bay;
  int storey;
};

// `at` in metres from the window's lower corner, `size` that of the window.
glm::vec3 window_colour(const glm::dvec2& at, const glm::dvec2& size, const Cell& cell, std::uint32_t salt) {
  const std::uint32_t window =
      hash(static_cast<std::uint32_t>(cell.bay), static_cast<std::uint32_t>(cell.storey), salt);
  const glm::dvec2 edge = glm::min(at, size - at);
  const bool mullion = std::abs(at.x - 0.5 * size.x) < 0.035 || std::abs(at.y - 0.72 * size.y) < 0.03;
  if (edge.x < kFrame || edge.y < kFrame || mullion) return glm::vec3(unit(salt) < 0.6f ? 0.86f : 0.25f);

  const double kind = unit(window);
  const float wave = value_noise(at.x * 13.0, at.y * 0.7, window);
  const bool curtained = at.x < size.x * (kind - 0.2) || at.x > size.x * (1.2 - kind);
  if (kind > 0.8) {
    // Slats of a blind, 8 cm each
    const double slat = fraction_of(at.y / 0.08);
    return glm::vec3(0.72f, 0.7f, 0.64f) * (slat < 0.25 ? 0.55f : 1.0f);
  }
  if (kind > 0.3 && kind < 0.65 && curtained) return glm::vec3(0.78f, 0.74f, 0.66f) * (0.5f + 0.5f * wave);
  // Glass mirrors a brighter sky above, broken by clouds
  const float cloud = fractal_noise(at.x * 0.8 + 3.0 * cell.bay, at.y * 1.1 + 3.0 * cell.storey, 4, salt + 3);
  const auto up = static_cast<float>(at.y / size.y);
  return glm::mix(glm::vec3(0.07f, 0.1f, 0.13f), glm::vec3(0.42f, 0.53f, 0.62f),
                  0.15f + 0.35f * up * cloud + 0.5f * cloud * cloud);
}

// Place and inward normal of a point on the four sides of the opening; `run` along them from the lower left corner,
// anticlockwise.
struct Reveal {
  glm::dvec2 at;
  glm::dvec2 normal;
};
Reveal reveal_at(const Window& window, double run) {
  const glm::dvec2 size = window.high - window.low;
  if (run < size.x) return {{window.low.x + run, window.low.y}, {0, 1}};
  run -= size.x;
  if (run < size.y) return {{window.high.x, window.low.y + run}, {-1, 0}};
  run -= size.y;
  if (run < size.x) return {{window.high.x - run, window.high.y}, {0, -1}};
  return {{window.low.x, window.high.y - (run - size.x)}, {1, 0}};
}

}  // namespace

glm::vec3 wall_colour(const Building& building, double u, double v) {
  switch (building.wall) {
    case WallKind::brick:
      return brick_wall(u, v, building.colour, building.salt);
    case WallKind::plaster:
      return plaster(u, v, building.colour, building.salt);
    case WallKind::panel:
      return 0.95f * paving(u, v, building.storey_height, building.colour, building.salt);
    case WallKind::curtain:
      return 0.9f * plaster(u, v, building.colour, building.salt);
  }
  return {};
}

ScenePoint sample_facade(const Building& building, const Surface& surface, PointRandom& random) {
  const FacadeGrid grid = facade_grid(building, surface);
  const Window& window = grid.window;
  const glm::dvec3 right = glm::normalize(surface.edge_u);
  const glm::dvec3 outward(right.y, -right.x, 0);
  const Cell cell{static_cast<int>(random.below(static_cast<std::uint32_t>(grid.bays))),
                  static_cast<int>(random.below(static_cast<std::uint32_t>(grid.storeys)))};

  glm::dvec2 at;
  glm::dvec3 normal = outward;
  double depth = 0;
  bool pane = false;
  if (random.uniform() * grid.cell_area() < window.reveal_area()) {
    const glm::dvec2 size = window.high - window.low;
    const Reveal reveal = reveal_at(window, random.uniform(0, 2 * (size.x + size.y)));
    at = reveal.at;
    normal = reveal.normal.x * right + glm::dvec3(0, 0, reveal.normal.y);
    depth = random.uniform(0, Window::kDepth);
  } else {
    at = {random.uniform(0, grid.bay_width), random.uniform(0, grid.storey_height)};
    pane = glm::all(glm::greaterThan(at, window.low)) && glm::all(glm::lessThan(at, window.high));
    if (pane) depth = Window::kDepth;
  }

  const double u = cell.bay * grid.bay_width + at.x;
  const double v = cell.storey * grid.storey_height + at.y;
  ScenePoint point;
  point.position = surface.origin + u * right + glm::dvec3(0, 0, v) - depth * outward;
  if (pane)
    point.colour = window_colour(at - window.low, window.high - window.low, cell, building.salt);
  else
    point.colour = wall_colour(building, u, v);
  // Sills and string courses stand out as a lighter band below each row of windows
  if (!pane && building.wall != WallKind::curtain && at.y > window.low.y - 0.14 && at.y < window.low.y)
    point.colour = glm::mix(point.colour, glm::vec3(0.8f, 0.78f, 0.72f), 0.65f);
  const double above = point.position.z - surface.origin.z;
  const auto corner = static_cast<float>(0.8 + 0.2 * smooth_step(0, 4, above));
  point.colour *= sunlight(glm::vec3(normal)) * (depth > 0 && !pane ? 0.75f : 1.0f) * corner;
  point.intensity = pane ? 0.1f : 0.2f + 0.6f * luminance(point.colour);
  point.point_class = PointClass::building;
  return point;
}

}  // namespace stipple::scene
