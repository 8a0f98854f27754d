// Casting rays at boxes and cylinders.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace stipple::scene {

// Four lanes of one register; GCC and Clang take arithmetic, comparison and choice on it.
using Float4 [[gnu::vector_size(16)]] = float;

enum class Finish : std::uint8_t {
  paint,
  tiles,
  parquet,
  carpet,
  ceiling,
  glass,
  wood,
  metal,
  books,
  fabric,
  picture,
  stone,
  card
};

// An upright box turned about the vertical, or an upright elliptic cylinder inside that box.
struct Solid {
  glm::vec3 centre{0.0f};
  glm::vec3 half{0.5f};        // half the extent along its own axes
  glm::vec2 axis{1.0f, 0.0f};  // (cosine, sine) of the turn
  bool round = false;          // a cylinder; half.x is its radius
  Finish finish = Finish::paint;
  glm::vec3 colour{1.0f};
};

struct Hit {
  float range = 0.0f;  // in lengths of the direction; infinite when nothing was hit
  std::uint32_t solid = 0;
  glm::vec3 place{0.0f};   // from the solid's centre, along its own axes
  glm::vec3 face{0.0f};    // outward normal along its own axes
  glm::vec3 normal{0.0f};  // the same in world axes
};

// A bounding volume hierarchy of four children a node, split by the surface area heuristic (Goldsmith, Salmon 1987).
class SolidTree {
 public:
  // Needs at least one solid.
  explicit SolidTree(std::vector<Solid> solids);

  // The nearest surface that the ray enters. What contains the origin is not seen.
  Hit cast(const glm::vec3& origin, const glm::vec3& direction) const;
  const Solid& solid(std::uint32_t index) const { return solids_[index]; }

 private:
  static constexpr std::uint32_t kLanes = 4;

  // Boxes of the children side by side, so that a ray meets all four at once.
  struct Node {
    Float4 low[3] = {};  // x, y, z
    Float4 high[3] = {};
    std::uint32_t child[kLanes] = {};  // index of a node, or of a solid
    bool is_solid[kLanes] = {};
    std::uint32_t count = 0;
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  // Solid `index`, if the ray enters it nearer than `best`.
  void test(std::uint32_t index, const glm::vec3& origin, const glm::vec3& direction, Hit& best) const;

  std::vector<Solid> solids_;
  std::vector<Node> nodes_;
};

}  // namespace stipple::scene
