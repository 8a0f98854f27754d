#include "src/scene/interior.h"

#include <algorithm>
#include <cmath>

#include "src/scene/interior_plan.h"
#include "src/scene/noise.h"
#include "src/scene/random.h"
#include "src/scene/solid_tree.h"
#include "src/scene/texture.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr double kLowest = -0.18;           // turns; nearer the ground the tripod is in the way
constexpr double kHighest = 0.25;           // straight up
constexpr double kRangeNoise = 0.002;       // metres, one sigma
constexpr double kBeamDivergence = 0.0008;  // between the middle and the rim of a beam, as a tangent
constexpr double kStray = 2e-5;             // share of rays that return from nowhere
// A beam that straddles an edge returns a range in between: looked for in this share of rays, kept over kEdgeStep
// metres
constexpr double kSplit = 0.05;
constexpr double kEdgeStep = 0.1;

glm::vec3 book_colour(double along, double up, std::uint32_t salt) {
  const auto book = floor_of(along / 0.035);
  const float tone = cell_value(book, 0, salt);
  const glm::vec3 cover =
      glm::mix(glm::vec3(0.65f, 0.25f, 0.15f), glm::vec3(0.15f, 0.3f, 0.5f), cell_value(book, 1, salt));
  const double across = along / 0.035 - static_cast<double>(book);
  if (across < 0.1) return glm::vec3(0.08f);
  const bool label = up > 0.02 && up < 0.06 + 0.03 * tone && tone > 0.3f;
  return (label ? glm::vec3(0.85f, 0.8f, 0.6f) : cover) * (0.6f + 0.5f * tone);
}

glm::vec3 picture_colour(const glm::dvec2& uv, const glm::dvec2& half, const glm::vec3& base, std::uint32_t salt) {
  const glm::dvec2 edge = half - glm::abs(uv);
  if (std::min(edge.x, edge.y) < 0.03) return glm::vec3(0.15f, 0.12f, 0.1f);
  const float a = fractal_noise(uv.x * 3.0, uv.y * 3.0, 5, salt);
  const float b = fractal_noise(uv.x * 5.0 + 4.0 * a, uv.y * 5.0, 4, salt + 1);
  return glm::mix(base, glm::vec3(0.85f, 0.75f, 0.5f), b) * (0.4f + 1.1f * a);
}

// Colour of the solid where it was hit; (u, v) are metres on the face, v upwards on upright ones.
glm::vec3 finish_colour(const Solid& solid, const Hit& hit, std::uint32_t salt) {
  const glm::vec3 p = hit.place;
  double u = std::abs(hit.face.x) > std::abs(hit.face.y) ? p.y : p.x;
  double v = p.z;
  if (hit.face.z != 0) {
    u = p.x + solid.centre.x;
    v = p.y + solid.centre.y;
  } else if (solid.axis.y == 0.0f) {
    u += std::abs(hit.face.x) > std::abs(hit.face.y) ? solid.centre.y : solid.centre.x;
  }
  const bool underside = hit.face.z < 0;
  switch (solid.finish) {
    case Finish::tiles:
      return paving(u, v, 0.45, solid.colour, salt);
    case Finish::ceiling:
      return paving(u, v, 0.625, solid.colour, salt);
    case Finish::parquet:
      return underside ? paving(u, v, 0.625, glm::vec3(0.88f), salt) : boards(u, v, solid.colour, salt);
    case Finish::carpet: {
      if (underside) return paving(u, v, 0.625, glm::vec3(0.88f), salt);
      const float pile = fractal_noise(u * 40.0, v * 40.0, 2, salt);
      const float worn = fractal_noise(u * 0.5, v * 0.5, 3, salt + 1);
      return solid.colour * (0.6f + 0.4f * pile + 0.4f * worn);
    }
    case Finish::glass: {
      const float cloud = fractal_noise(u * 0.9, v * 1.6, 5, salt);
      return glm::mix(solid.colour, glm::vec3(0.95f), cloud) * static_cast<float>(0.9 + 0.15 * v);
    }
    case Finish::wood:
      return boards(v, u, solid.colour, salt);
    case Finish::books:
      return book_colour(u, p.z + solid.half.z, salt + 7);
    case Finish::fabric:
      return solid.colour * (0.6f + 0.6f * fractal_noise(u * 30.0, v * 30.0, 3, salt));
    case Finish::picture:
      return picture_colour({std::abs(hit.face.x) > 0.5f ? p.y : p.x, p.z},
                            {std::max(solid.half.x, solid.half.y), solid.half.z}, solid.colour, salt);
    case Finish::card:
      return std::abs(p.y) < 0.03f ? solid.colour * 0.8f : plaster(u * 3.0, v * 3.0, solid.colour, salt);
    case Finish::metal:
      return solid.colour * (0.85f + 0.25f * fractal_noise(u * 4.0, v * 4.0, 3, salt));
    case Finish::stone:
      return solid.colour * (0.5f + 0.7f * fractal_noise(u * 6.0, v * 6.0, 5, salt));
    case Finish::paint:
      break;
  }
  // A dado of darker paint, as in schools, and a skirting board
  const float above = p.z + solid.centre.z - (p.z + solid.centre.z > kUpperFloor - 0.15f ? kUpperFloor : 0.0f);
  if (hit.face.z == 0 && above < 0.08f) return glm::vec3(0.35f, 0.28f, 0.22f);
  return plaster(u, v, solid.colour, salt) * (above < 1.1f ? glm::vec3(0.82f, 0.86f, 0.84f) : glm::vec3(1.0f));
}

// Lamps hang every four metres; corners are darker than open walls.
float lamp_light(const glm::dvec3& at, const glm::vec3& normal) {
  const glm::dvec2 from_lamp(fraction_of(at.x / 4.0) - 0.5, fraction_of(at.y / 4.0) - 0.5);
  const auto pool = static_cast<float>(1 - 1.1 * glm::dot(from_lamp, from_lamp));
  const double height = at.z > kUpperFloor - 0.15 ? at.z - kUpperFloor : at.z;
  const auto corner = static_cast<float>(0.82 + 0.18 * smooth_step(0.0, 0.5, height) * smooth_step(3.4, 3.0, height));
  return (0.62f + 0.16f * normal.z + 0.06f * normal.x + 0.1f * normal.y + 0.28f * pool) * corner;
}

class Interior : public SceneModel {
 public:
  Interior(std::uint64_t points, std::uint64_t seed)
      : points_(points),
        seed_(seed),
        salt_(static_cast<std::uint32_t>(mix64(seed ^ 0x1417E7ull))),
        tree_(furnish_house(seed)) {}

  Grid grid() const override { return {{2600.0, 1200.0, 100.0}, glm::dvec3(0.001)}; }
  WorldBox bounds() const override {
    constexpr double kMargin = 0.5;  // window panes lie in the walls
    const glm::dvec3 origin = grid().offset;
    return {origin - kMargin, origin + glm::dvec3(kHouseSize) + kMargin};
  }

  ScenePoint point(std::uint64_t index) const override {
    PointRandom random(seed_, index);
    const std::uint64_t scans = interior_scanners().size();
    const std::uint64_t scan = std::min(index * scans / points_, scans - 1);
    const glm::vec3 origin(interior_scanners()[scan]);
    const glm::dvec3 direction = beam(scan, index);
    const Hit hit = tree_.cast(origin, glm::vec3(direction));
    return returned(origin, direction, hit, random);
  }

 private:
  // Direction of ray `index` of the scan that holds it.
  glm::dvec3 beam(std::uint64_t scan, std::uint64_t index) const {
    const std::uint64_t scans = interior_scanners().size();
    const std::uint64_t first = (scan * points_ + scans - 1) / scans;
    const std::uint64_t end = ((scan + 1) * points_ + scans - 1) / scans;
    const auto rays = static_cast<double>(end - first);
    // As many steps up a column that the same step around yields the number of rays
    const double rows = std::max(1.0, static_cast<double>(floor_of(std::sqrt(rays * (kHighest - kLowest)))));
    const auto ray = static_cast<double>(index - first);
    const double column = static_cast<double>(floor_of(ray / rows));
    const double elevation = kLowest + (kHighest - kLowest) * (ray - column * rows + 0.5) / rows;
    const double azimuth = column * rows / rays + 0.013 * static_cast<double>(scan);
    return glm::dvec3(cos_turns(elevation) * direction_from_turns(azimuth), sin_turns(elevation));
  }

  ScenePoint returned(const glm::vec3& origin, const glm::dvec3& direction, const Hit& hit, PointRandom& random) const {
    const Solid& solid = tree_.solid(hit.solid);
    double range = hit.range;
    ScenePoint point;
    // Grazing incidence smears the range
    const auto incidence = static_cast<float>(std::abs(glm::dot(direction, glm::dvec3(hit.normal))));
    const double noise = kRangeNoise * (1.0 + 0.05 * range) * random.normal();
    if (random.uniform() < kSplit) range = split_range(origin, direction, range, random);
    const bool stray = random.uniform() < kStray;
    if (stray) range *= random.uniform(0.3, 0.95);
    point.position = glm::dvec3(origin) + (range + noise) * direction;
    point.colour = 1.15f * finish_colour(solid, hit, salt_) * lamp_light(point.position, hit.normal);
    point.intensity = (0.15f + 0.75f * luminance(point.colour)) * (0.4f + 0.6f * incidence);
    point.point_class = stray ? PointClass::low_noise : class_of(solid, hit);
    return point;
  }

  double split_range(const glm::vec3& origin, const glm::dvec3& direction, double range, PointRandom& random) const {
    const glm::dvec3 rim =
        direction + kBeamDivergence * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double other = tree_.cast(origin, glm::vec3(rim)).range;
    return std::abs(other - range) > kEdgeStep ? glm::mix(range, other, random.uniform()) : range;
  }

  static PointClass class_of(const Solid& solid, const Hit& hit) {
    switch (solid.finish) {
      case Finish::tiles:
      case Finish::parquet:
      case Finish::carpet:
        return hit.face.z > 0 ? PointClass::ground : PointClass::building;
      case Finish::paint:
      case Finish::ceiling:
      case Finish::glass:
        return PointClass::building;
      default:
        return PointClass::unclassified;
    }
  }

  std::uint64_t points_;
  std::uint64_t seed_;
  std::uint32_t salt_;
  SolidTree tree_;
};

}  // namespace

const std::vector<glm::dvec3>& interior_scanners() {
  constexpr double kTripod = 1.6;
  constexpr double kUpstairs = kUpperFloor + kTripod;
  static const std::vector<glm::dvec3> kScanners{
      {20.0, 5.5, kTripod},    {16.8, 12.6, kTripod},   {6.0, 15.5, kTripod},    {34.0, 15.5, kTripod},
      {6.0, 3.5, kTripod},     {34.0, 10.5, kTripod},   {12.0, 20.5, kTripod},   {28.0, 20.5, kTripod},
      {20.0, 12.6, kUpstairs}, {33.0, 15.5, kUpstairs}, {20.0, 20.5, kUpstairs}, {6.0, 10.5, kUpstairs}};
  return kScanners;
}

std::unique_ptr<SceneModel> make_interior(std::uint64_t points, std::uint64_t seed) {
  return std::make_unique<Interior>(points, seed);
}

}  // namespace stipple::scene
