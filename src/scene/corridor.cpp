#include "src/scene/corridor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/scene/area_table.h"
#include "src/scene/noise.h"
#include "src/scene/railway_line.h"
#include "src/scene/random.h"
#include "src/scene/texture.h"
#include "src/scene/track_section.h"
#include "src/scene/tree.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr double kMastOffset = 5.4;     // from the middle of the line
constexpr double kContactHeight = 6.3;  // of the contact wire, over the foot of the ballast
constexpr double kMessengerHeight = 7.8;
constexpr double kMastHeight = 8.4;
constexpr int kPlantsPerSpan = 26;

enum class Part : std::uint8_t { ground, rails, masts, wires, plant };

// A share of the file. Thin things get more than their area's, as from a scanner that sees them from all sides.
struct Piece {
  Part part;
  std::uint32_t number;  // of the plant, or of the span
};

// Coordinates along a span: metres ahead of its start, left of the middle and over the foot of the ballast.
struct SpanPlace {
  double along;
  double left;
  double above;
};

class Corridor : public SceneModel {
 public:
  Corridor(std::uint64_t points, std::uint64_t seed)
      : points_(points), seed_(seed), salt_(static_cast<std::uint32_t>(mix64(seed ^ 0xC0441D04ull))) {
    for (std::uint32_t span = 0; span < line_.spans(); ++span) {
      add_piece(Part::ground, span, 60.0 * kSpan);
      add_piece(Part::rails, span, 7.0 * kSpan);
      add_piece(Part::masts, span, 2.6 * kSpan);
      add_piece(Part::wires, span, 4.0 * kSpan);
      plant(span);
    }
  }

  Grid grid() const override { return {{300000.0, 5300000.0, 400.0}, glm::dvec3(0.01)}; }
  WorldBox bounds() const override {
    constexpr double kReach = 3200.0;  // of the bends
    const glm::dvec3 origin = grid().offset;
    return {origin + glm::dvec3(-60, -kReach, -120), origin + glm::dvec3(kLineLength + 120, kReach, 150)};
  }

  ScenePoint point(std::uint64_t index) const override {
    PointRandom random(seed_, index);
    const double place = (static_cast<double>(index) + random.uniform()) / static_cast<double>(points_);
    const Piece& piece = pieces_[shares_.pick(place)];
    if (piece.part == Part::plant) return sample_tree(plants_[piece.number], random);
    if (piece.part == Part::masts) return sample_mast(piece.number, random);
    const double along = random.uniform(0, kSpan);
    if (piece.part == Part::rails) return sample_rail(piece.number, along, random);
    if (piece.part == Part::wires) return sample_wire(piece.number, along, random);
    return sample_ground(piece.number, along, random);
  }

 private:
  void add_piece(Part part, std::uint32_t number, double share) {
    pieces_.push_back({part, number});
    shares_.add(share);
  }

  // Bushes on the slopes and trees beside the line, in stretches of some hundred metres.
  void plant(std::uint32_t span) {
    PointRandom random(seed_ ^ 0x91A27ull, span);
    for (int i = 0; i < kPlantsPerSpan; ++i) {
      const double along = random.uniform(0, kSpan);
      const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
      const double away = random.uniform(9.5, 26.0);
      const double size = random.uniform();
      const double chainage = kSpan * span + along;
      const float wood = fractal_noise(chainage / 500.0, 5.0 * side, 3, salt_ + 51);
      const bool tall = wood > 0.5f && size > 0.35 && away > 18.5;
      if (!tall && (wood < 0.42f || (side > 0 && away > 24.0))) continue;
      Tree tree;
      tree.salt = static_cast<std::uint32_t>(random.bits());
      tree.species = tall ? tall_species(tree.salt) : Species::shrub;
      tree.height = tall ? 5.0 + 9.0 * size : 0.6 + 1.8 * size;
      tree.crown_radius = tree.height * (tall ? 0.22 : 0.55);
      tree.foot = world(span, {along, side * away, track_surface(chainage, side * away, salt_).height - 0.05});
      add_piece(Part::plant, static_cast<std::uint32_t>(plants_.size()), surface_area(tree));
      plants_.push_back(tree);
    }
  }

  static Species tall_species(std::uint32_t salt) {
    if (salt & 3) return Species::broadleaf;
    return salt & 4 ? Species::birch : Species::conifer;
  }

  glm::dvec3 world(std::uint32_t span, const SpanPlace& place) const {
    const LinePlace line = line_.at(span, place.along);
    return glm::dvec3(glm::dvec2(line.centre) + place.left * line.left, line.centre.z + place.above);
  }

  static void shade(ScenePoint& point, const glm::vec3& colour, const glm::vec3& normal, PointClass point_class) {
    point.colour = colour * sunlight(normal);
    point.intensity = 0.1f + 0.8f * luminance(colour);
    point.point_class = point_class;
  }

  ScenePoint sample_ground(std::uint32_t span, double along, PointRandom& random) const {
    const double left = random.uniform(-kHalfStrip, kHalfStrip);
    const double chainage = kSpan * span + along;
    const TrackSurface surface = track_surface(chainage, left, salt_);
    const LinePlace line = line_.at(span, along);
    ScenePoint point;
    point.position = glm::dvec3(glm::dvec2(line.centre) + left * line.left, line.centre.z + surface.height);
    const glm::dvec2 tilt = -surface.slope_left * line.left;
    shade(point, surface.colour, glm::normalize(glm::vec3(tilt.x, tilt.y, 1.0)), surface.point_class);
    return point;
  }

  // Head, web and foot of one of four rails.
  ScenePoint sample_rail(std::uint32_t span, double along, PointRandom& random) const {
    const double middle = kRailOffsets[random.below(4)];
    const double u = random.uniform();
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    SpanPlace place{along, middle, kRailFoot};
    glm::vec3 colour(0.42f, 0.27f, 0.19f);
    glm::vec3 normal(0, 0, 1);
    if (u < 0.35) {
      place.left += random.uniform(-0.036, 0.036);
      place.above += kRailHeight;
      colour = {0.72f, 0.73f, 0.75f};
    } else if (u < 0.75) {
      place.left += side * (u < 0.5 ? 0.036 : 0.012);
      place.above += u < 0.5 ? random.uniform(0.12, kRailHeight) : random.uniform(0.02, 0.12);
      normal = {0, 0.7f, 0.4f};
    } else {
      place.left += side * random.uniform(0.012, 0.075);
      place.above += 0.02;
    }
    ScenePoint point;
    point.position = world(span, place);
    shade(point, colour * (0.75f + 0.5f * fractal_noise(along * 3.0, middle * 7.0 + span, 3, salt_ + 31)), normal,
          PointClass::rail);
    return point;
  }

  // A lattice mast on each side, its cantilever, and insulators.
  ScenePoint sample_mast(std::uint32_t span, PointRandom& random) const {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    const double u = random.uniform();
    SpanPlace place{0.0, side * kMastOffset, 0.0};
    glm::vec3 colour(0.5f, 0.54f, 0.52f);
    if (u < 0.08) {
      place.along = random.uniform(-0.35, 0.35);
      place.left += random.uniform(-0.35, 0.35);
      place.above += 0.25;
      colour = {0.66f, 0.65f, 0.62f};
    } else if (u < 0.55) {
      // Two U-sections, 30 cm apart
      place.along = random.uniform() < 0.5 ? -0.15 : 0.15;
      place.left += random.uniform(-0.05, 0.05);
      place.above += random.uniform(0, kMastHeight);
    } else if (u < 0.75) {
      // Lacing bars, to and fro
      const double t = random.uniform();
      place.along = std::abs(2 * (fraction_of(t * 11)) - 1) * 0.3 - 0.15;
      place.above += t * (kMastHeight) + random.uniform(-0.02, 0.02);
    } else {
      const double t = random.uniform();
      const bool tie = u > 0.88;
      place.left = side * (kMastOffset - t * (kMastOffset - kTrackOffset + (tie ? 0.0 : 0.3)));
      place.above = tie ? glm::mix(kMastHeight - 0.3, kMessengerHeight + 0.05, t)
                        : glm::mix(kContactHeight - 0.2, kMessengerHeight, t);
      place.above += random.uniform(-0.03, 0.03);
      place.along = random.uniform(-0.03, 0.03);
      if (t > 0.06 && t < 0.16) colour = {0.4f, 0.2f, 0.12f};
    }
    ScenePoint point;
    point.position = world(span, place);
    const float rust = fractal_noise(place.above * 1.2, place.left + 3.0 * span, 4, salt_ + 41);
    shade(point, glm::mix(colour, glm::vec3(0.42f, 0.3f, 0.2f), 0.9f * rust * rust) * (0.75f + 0.4f * rust),
          {-0.3f, -0.5f, 0.6f}, PointClass::tower);
    return point;
  }

  // Contact wire, messenger wire sagging over it, droppers every six metres; a feeder over the masts.
  ScenePoint sample_wire(std::uint32_t span, double along, PointRandom& random) const {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    const double u = random.uniform();
    const double from_middle = 2 * along / kSpan - 1;
    // The contact wire zigzags so as to wear the pantograph evenly
    const double stagger = (span & 1 ? 0.3 : -0.3) * from_middle;
    const double messenger = kMessengerHeight - 1.05 * (1 - from_middle * from_middle);
    SpanPlace place{along, side * (kTrackOffset + stagger), kContactHeight};
    if (u >= 0.35 && u < 0.7) {
      place.above = messenger;
    } else if (u >= 0.7 && u < 0.8) {
      place.along = 6.0 * static_cast<double>(floor_of(along / 6.0)) + 3.0;
      const double t = 2 * place.along / kSpan - 1;
      place.left = side * (kTrackOffset + (span & 1 ? 0.3 : -0.3) * t);
      place.above = random.uniform(kContactHeight, kMessengerHeight - 1.05 * (1 - t * t));
    } else if (u >= 0.8) {
      place.left = side * kMastOffset;
      place.above = kMastHeight + 0.4 - 0.7 * (1 - from_middle * from_middle);
    }
    ScenePoint point;
    point.position = world(span, place) + 0.008 * glm::dvec3(random.normal(), random.normal(), random.normal());
    shade(point, {0.3f, 0.31f, 0.3f}, {0, 0, 1}, PointClass::wire_conductor);
    return point;
  }

  std::uint64_t points_;
  std::uint64_t seed_;
  std::uint32_t salt_;
  RailwayLine line_;
  std::vector<Piece> pieces_;  // span by span
  AreaTable shares_;
  std::vector<Tree> plants_;
};

}  // namespace

std::unique_ptr<SceneModel> make_corridor(std::uint64_t points, std::uint64_t seed) {
  return std::make_unique<Corridor>(points, seed);
}

}  // namespace stipple::scene
