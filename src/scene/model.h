// What a scene is made of, before its points are put on a grid.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "octree/cloud/grid.h"

namespace stipple::scene {

// ASPRS standard classes, LAS 1.4 R15 table 17.
enum class PointClass : std::uint8_t {
  unclassified = 1,
  ground = 2,
  low_vegetation = 3,
  medium_vegetation = 4,
  high_vegetation = 5,
  building = 6,
  low_noise = 7,
  water = 9,
  rail = 10,
  road = 11,
  wire_conductor = 14,
  tower = 15
};

struct ScenePoint {
  glm::dvec3 position{0.0};  // metres from the grid's offset
  glm::vec3 colour{0.0f};    // 0 to 1; clamped when stored
  float intensity = 0.0f;    // 0 to 1; clamped when stored
  PointClass point_class = PointClass::unclassified;
};

// The geometry of one scene with a fixed number of points. Everything is settled in the constructor; afterwards any
// number of threads may ask for any point.
class SceneModel {
 public:
  virtual ~SceneModel() = default;
  SceneModel() = default;
  SceneModel(const SceneModel&) = delete;
  SceneModel& operator=(const SceneModel&) = delete;

  virtual Grid grid() const = 0;
  // Encloses every point, in world coordinates; not tight.
  virtual WorldBox bounds() const = 0;
  // A pure function of scene, number of points, seed and index.
  virtual ScenePoint point(std::uint64_t index) const = 0;
};

}  // namespace stipple::scene
