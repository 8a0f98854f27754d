#include "src/scene/interior_plan.h"

#include <algorithm>

#include "src/scene/random.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr float kRoom = 3.3f;   // clear height of a storey
constexpr float kOuter = 0.4f;  // thickness of walls
constexpr float kInner = 0.14f;
constexpr glm::vec3 kWhite{0.9f, 0.89f, 0.85f};
constexpr glm::vec3 kOak{0.62f, 0.45f, 0.28f};
constexpr glm::vec3 kDark{0.22f, 0.23f, 0.25f};

// A hole in a wall, in metres along it and above the floor.
struct Opening {
  float from;
  float to;
  float sill;
  float top;
};

class House {
 public:
  explicit House(std::uint64_t seed) : random_(seed, 1) {}

  PointRandom& random() { return random_; }
  std::vector<Solid> solids() && { return std::move(solids_); }

  void box(const glm::vec3& low, const glm::vec3& high, Finish finish, const glm::vec3& colour) {
    solids_.push_back({0.5f * (low + high), 0.5f * (high - low), {1, 0}, false, finish, colour});
  }

  // Boxes of one piece of furniture, given around its own foot.
  void turned_box(const glm::vec3& foot, const glm::vec2& axis, const glm::vec3& low, const glm::vec3& high,
                  Finish finish, const glm::vec3& colour) {
    const glm::vec3 c = 0.5f * (low + high);
    const glm::vec3 centre = foot + glm::vec3(axis.x * c.x - axis.y * c.y, axis.y * c.x + axis.x * c.y, c.z);
    solids_.push_back({centre, 0.5f * (high - low), axis, false, finish, colour});
  }

  void pillar(const glm::vec3& foot, float radius, float height, Finish finish, const glm::vec3& colour) {
    solids_.push_back(
        {foot + glm::vec3(0, 0, 0.5f * height), {radius, radius, 0.5f * height}, {1, 0}, true, finish, colour});
  }

  // A wall over `start` + [0, length] along x or y; `start` is its middle at the floor. Openings in rising order.
  void wall(const glm::vec3& start, bool along_x, float length, float thickness, const std::vector<Opening>& openings,
            const glm::vec3& colour) {
    const auto piece = [&](float from, float to, float low, float high) {
      if (to - from < 0.001f || high - low < 0.001f) return;
      const float t = 0.5f * thickness;
      const glm::vec3 a = along_x ? glm::vec3(from, -t, low) : glm::vec3(-t, from, low);
      const glm::vec3 b = along_x ? glm::vec3(to, t, high) : glm::vec3(t, to, high);
      box(start + a, start + b, Finish::paint, colour);
    };
    float at = 0;
    for (const Opening& hole : openings) {
      piece(at, hole.from, 0, kRoom);
      piece(hole.from, hole.to, 0, hole.sill);
      piece(hole.from, hole.to, hole.top, kRoom);
      at = hole.to;
    }
    piece(at, length, 0, kRoom);
  }

  // An outer wall with a window every 4 m: panes, a frame around and a ledge inside.
  void window_wall(const glm::vec3& start, bool along_x, float length, float inward) {
    std::vector<Opening> windows;
    for (float at = 1.0f; at + 2.0f < length; at += 4.0f) windows.push_back({at, at + 2.0f, 0.9f, 2.6f});
    wall(start, along_x, length, kOuter, windows, kWhite);
    const auto bar = [&](float from, float to, float low, float high, float out, float in, Finish finish,
                         const glm::vec3& c) {
      const float a = std::min(out * inward, in * inward);
      const float b = std::max(out * inward, in * inward);
      if (along_x)
        box(start + glm::vec3(from, a, low), start + glm::vec3(to, b, high), finish, c);
      else
        box(start + glm::vec3(a, from, low), start + glm::vec3(b, to, high), finish, c);
    };
    const glm::vec3 frame(0.8f);
    for (const Opening& w : windows) {
      bar(w.from, w.to, w.sill, w.top, -0.02f, 0.0f, Finish::glass, glm::vec3(0.6f, 0.72f, 0.85f));
      bar(w.from, w.from + 0.07f, w.sill, w.top, -0.05f, 0.04f, Finish::metal, frame);
      bar(w.to - 0.07f, w.to, w.sill, w.top, -0.05f, 0.04f, Finish::metal, frame);
      bar(w.from + 0.965f, w.from + 1.035f, w.sill, w.top, -0.05f, 0.04f, Finish::metal, frame);
      bar(w.from, w.to, w.top - 0.07f, w.top, -0.05f, 0.04f, Finish::metal, frame);
      bar(w.from, w.to, w.sill, w.sill + 0.07f, -0.05f, 0.04f, Finish::metal, frame);
      bar(w.from - 0.05f, w.to + 0.05f, w.sill - 0.04f, w.sill - 0.001f, 0.1f, 0.3f, Finish::stone, glm::vec3(0.7f));
      bar(w.from + 0.1f, w.to - 0.1f, 0.15f, 0.7f, 0.24f, 0.32f, Finish::metal, glm::vec3(0.85f));
    }
  }

  // A leaf 0.9 m wide, hung at `hinge` and open by `turns`.
  void door_leaf(const glm::vec3& hinge, double turns) {
    const glm::vec2 axis(direction_from_turns(turns));
    turned_box(hinge, axis, {0.02f, -0.02f, 0.01f}, {0.88f, 0.02f, 2.06f}, Finish::wood, kOak);
    turned_box(hinge, axis, {0.76f, -0.07f, 1.02f}, {0.86f, 0.07f, 1.05f}, Finish::metal, glm::vec3(0.6f));
  }

  void desk(const glm::vec3& foot, double turns) {
    const glm::vec2 axis(direction_from_turns(turns));
    turned_box(foot, axis, {-0.8f, -0.4f, 0.71f}, {0.8f, 0.4f, 0.74f}, Finish::wood, kOak * 1.1f);
    for (const float x : {-0.76f, 0.7f})
      for (const float y : {-0.36f, 0.3f})
        turned_box(foot, axis, {x, y, 0}, {x + 0.06f, y + 0.06f, 0.71f}, Finish::metal, kDark);
    turned_box(foot, axis, {-0.28f, 0.1f, 0.85f}, {0.28f, 0.14f, 1.2f}, Finish::picture, glm::vec3(0.25f, 0.35f, 0.5f));
    turned_box(foot, axis, {-0.04f, 0.15f, 0.74f}, {0.04f, 0.2f, 1.0f}, Finish::metal, kDark);
    turned_box(foot, axis, {-0.22f, -0.22f, 0.74f}, {0.22f, -0.08f, 0.765f}, Finish::metal, kDark);
    turned_box(foot, axis, {0.45f, -0.25f, 0.74f},
               {0.66f, 0.05f, 0.74f + static_cast<float>(random_.uniform(0.02, 0.15))}, Finish::books, glm::vec3(0.8f));
    chair(foot + glm::vec3(-axis.y, axis.x, 0) * -0.75f, turns + random_.uniform(-0.12, 0.12));
  }

  void chair(const glm::vec3& foot, double turns) {
    static constexpr glm::vec3 kCloth[] = {{0.2f, 0.3f, 0.5f}, {0.55f, 0.2f, 0.18f}, {0.25f, 0.4f, 0.3f}};
    const glm::vec2 axis(direction_from_turns(turns));
    const glm::vec3 cloth = kCloth[random_.below(3)];
    turned_box(foot, axis, {-0.23f, -0.23f, 0.42f}, {0.23f, 0.23f, 0.48f}, Finish::fabric, cloth);
    turned_box(foot, axis, {-0.23f, -0.25f, 0.55f}, {0.23f, -0.21f, 0.95f}, Finish::fabric, cloth);
    for (const float x : {-0.21f, 0.17f})
      for (const float y : {-0.21f, 0.17f})
        turned_box(foot, axis, {x, y, 0}, {x + 0.04f, y + 0.04f, 0.42f}, Finish::metal, kDark);
  }

  // Shelves with books, 1.2 m wide, back at y = 0 of its own axes.
  void shelf(const glm::vec3& foot, double turns) {
    const glm::vec2 axis(direction_from_turns(turns));
    turned_box(foot, axis, {-0.6f, 0, 0}, {0.6f, 0.02f, 2.1f}, Finish::wood, kOak);
    turned_box(foot, axis, {-0.63f, 0, 0}, {-0.6f, 0.32f, 2.1f}, Finish::wood, kOak);
    turned_box(foot, axis, {0.6f, 0, 0}, {0.63f, 0.32f, 2.1f}, Finish::wood, kOak);
    for (int k = 0; k < 6; ++k) {
      const float z = 0.4f * static_cast<float>(k);
      turned_box(foot, axis, {-0.6f, 0.02f, z}, {0.6f, 0.31f, z + 0.03f}, Finish::wood, kOak);
      const auto filled = static_cast<float>(random_.uniform(-0.5, 0.55));
      if (k < 5)
        turned_box(foot, axis, {-0.59f, 0.04f, z + 0.03f},
                   {filled, 0.26f, z + static_cast<float>(random_.uniform(0.24, 0.34))}, Finish::books,
                   glm::vec3(0.9f));
    }
  }

  void carton(const glm::vec3& foot) {
    const glm::vec3 size(random_.uniform(0.25, 0.6), random_.uniform(0.25, 0.5), random_.uniform(0.2, 0.5));
    turned_box(foot, glm::vec2(direction_from_turns(random_.uniform())), -0.5f * glm::vec3(size.x, size.y, 0),
               {0.5f * size.x, 0.5f * size.y, size.z}, Finish::card, {0.68f, 0.52f, 0.34f});
  }

 private:
  PointRandom random_;
  std::vector<Solid> solids_;
};

// A room that spans `low` to `high`; its middle stays free for the scanner.
void furnish_room(House& house, const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 floor(0, 0, low.z);
  const glm::vec2 size(high - low);
  const glm::vec2 middle(0.5f * (low + high));
  house.desk(floor + glm::vec3(low.x + 1.2f, middle.y + 0.24f * size.y, 0), 0.25 + house.random().uniform(-0.02, 0.02));
  house.desk(floor + glm::vec3(high.x - 1.2f, middle.y + 0.22f * size.y, 0),
             0.75 + house.random().uniform(-0.02, 0.02));
  house.shelf(floor + glm::vec3(low.x + 0.09f, middle.y - 0.2f * size.y, 0), 0.75);
  house.shelf(floor + glm::vec3(high.x - 0.09f, middle.y - 0.15f * size.y, 0), 0.25);
  for (int i = 0; i < 4; ++i)
    house.carton(floor + glm::vec3(middle.x + house.random().uniform(1.1, 1.7),
                                   middle.y - 0.25f * size.y + 0.55f * static_cast<float>(i % 2), 0));
  house.box({middle.x - 0.7f, high.y - 0.1f, low.z + 1.2f}, {middle.x + 0.7f, high.y - 0.075f, low.z + 2.1f},
            Finish::picture, {0.6f, 0.45f, 0.3f});
  for (float x = low.x + 1.6f; x < high.x - 0.8f; x += 2.6f)
    house.box({x - 0.6f, middle.y - 0.1f, low.z + 3.05f}, {x + 0.6f, middle.y + 0.1f, low.z + 3.13f}, Finish::metal,
              glm::vec3(1.3f));
}

void build_storey(House& house, float z) {
  static constexpr glm::vec3 kPaints[] = {{0.85f, 0.82f, 0.7f}, {0.72f, 0.8f, 0.82f}, {0.85f, 0.72f, 0.62f}};
  const float half = 0.5f * kOuter;
  house.window_wall({0, -half, z}, true, kHouseSize.x, 1);
  house.window_wall({0, kHouseSize.y + half, z}, true, kHouseSize.x, -1);
  house.window_wall({-half, 0, z}, false, kHouseSize.y, 1);
  house.window_wall({kHouseSize.x + half, 0, z}, false, kHouseSize.y, -1);

  // Rooms north of the passage, a door each
  std::vector<Opening> doors;
  for (float x = 0; x < 40; x += 8) doors.push_back({x + 2, x + 2.9f, 0, 2.1f});
  house.wall({0, 17, z}, true, 40, kInner, doors, kPaints[0]);
  for (float x = 0; x < 40; x += 8) {
    house.door_leaf({x + 2, 17.07f, z}, house.random().uniform(0.12, 0.3));
    if (x > 0) house.wall({x, 17.07f, z}, false, 6.93f, kInner, {}, kPaints[static_cast<int>(x) % 3]);
    furnish_room(house, {x, 17, z}, {x + 8, 24, z + kRoom});
  }

  // Rooms west and east of the hall, doors to the passage and to the hall's gallery side
  for (const float x : {0.0f, 28.0f}) {
    const float hall_side = x == 0 ? 12.0f : 28.0f;
    house.wall({x, 14, z}, true, 12, kInner, {{5, 5.9f, 0, 2.1f}}, kPaints[1]);
    house.wall({hall_side, 0, z}, false, 13.93f, kInner, {{12.2f, 13.1f, 0, 2.1f}}, kPaints[2]);
    house.wall({x + (x == 0 ? 0.0f : 0.07f), 7, z}, true, 11.93f, kInner, {{3, 3.9f, 0, 2.1f}}, kPaints[0]);
    house.door_leaf({x + 5, 13.93f, z}, house.random().uniform(-0.3, -0.12));
    furnish_room(house, {x, 0, z}, {x + 12, 7, z + kRoom});
    furnish_room(house, {x, 7, z}, {x + 12, 14, z + kRoom});
  }
}

void build_stairs(House& house, float x, float toward) {
  constexpr int kSteps = 20;
  constexpr float kRise = kUpperFloor / kSteps;
  constexpr float kRun = 0.29f;
  for (int k = 0; k < kSteps; ++k) {
    const float y = 11.0f - kRun * static_cast<float>(kSteps - k);
    const float top = kRise * static_cast<float>(k + 1);
    house.box({x, y, std::max(0.0f, top - 0.4f)}, {x + 1.6f, y + kRun, top - 0.001f}, Finish::stone,
              {0.7f, 0.68f, 0.64f});
    const float rail = x + (toward > 0 ? 1.57f : 0.03f);
    house.pillar({rail, y + 0.5f * kRun, top}, 0.012f, 0.9f, Finish::metal, kDark);
    house.box({rail - 0.03f, y, top + 0.8f}, {rail + 0.03f, y + kRun, top + 0.98f}, Finish::wood, kOak);
  }
}

void build_hall(House& house) {
  for (const float x : {15.5f, 24.5f})
    for (const float y : {3.5f, 8.0f}) {
      house.pillar({x, y, 0}, 0.28f, kHouseSize.z, Finish::stone, {0.76f, 0.74f, 0.7f});
      house.pillar({x, y, 0}, 0.42f, 0.25f, Finish::stone, {0.6f, 0.58f, 0.55f});
      house.pillar({x, y, kHouseSize.z - 0.25f}, 0.42f, 0.25f, Finish::stone, {0.6f, 0.58f, 0.55f});
    }
  build_stairs(house, 12.1f, 1);
  build_stairs(house, 26.3f, -1);

  // Railing of the gallery between the two flights
  for (float x = 13.8f; x < 26.25f; x += 0.125f)
    house.pillar({x, 11.05f, kUpperFloor}, 0.01f, 0.95f, Finish::metal, kDark);
  house.box({13.75f, 11.02f, kUpperFloor + 0.95f}, {26.28f, 11.08f, kUpperFloor + 1.0f}, Finish::wood, kOak);

  // Reception, benches, plants in tubs
  house.box({18.0f, 9.6f, 0}, {22.0f, 10.2f, 1.1f}, Finish::wood, kOak * 0.8f);
  house.box({17.9f, 9.5f, 1.1f}, {22.1f, 10.3f, 1.15f}, Finish::stone, kDark * 1.5f);
  for (const float x : {14.5f, 21.6f}) {
    house.box({x, 1.0f, 0.38f}, {x + 2.4f, 1.5f, 0.45f}, Finish::wood, kOak);
    for (const float leg : {0.2f, 2.0f})
      house.box({x + leg, 1.05f, 0}, {x + leg + 0.2f, 1.45f, 0.38f}, Finish::stone, glm::vec3(0.5f));
  }
  for (const glm::vec2 at : {glm::vec2(17.5f, 1.0f), glm::vec2(26.5f, 0.9f), glm::vec2(13.0f, 0.9f)}) {
    house.pillar({at, 0}, 0.35f, 0.5f, Finish::stone, {0.5f, 0.3f, 0.22f});
    for (int i = 0; i < 40; ++i) {
      PointRandom& random = house.random();
      const glm::vec2 out(0.45 * random.uniform() * direction_from_turns(random.uniform()));
      house.turned_box({at + out, 0.5f + static_cast<float>(random.uniform(0.05, 1.1))},
                       glm::vec2(direction_from_turns(random.uniform())), {-0.12f, -0.03f, -0.02f},
                       {0.12f, 0.03f, 0.02f}, Finish::fabric, {0.2f, 0.42f, 0.16f});
    }
  }
}

}  // namespace

std::vector<Solid> furnish_house(std::uint64_t seed) {
  House house(seed);
  const glm::vec3 size = kHouseSize;
  const glm::vec3 cream(0.9f, 0.88f, 0.82f);

  // Ground floor, roof, and the floor between, which leaves the hall open to its gallery
  house.box({-kOuter, -kOuter, -0.3f}, {size.x + kOuter, size.y + kOuter, 0}, Finish::tiles, {0.72f, 0.68f, 0.62f});
  house.box({-kOuter, -kOuter, size.z}, {size.x + kOuter, size.y + kOuter, size.z + 0.3f}, Finish::ceiling, cream);
  house.box({-kOuter, 11, kRoom}, {size.x + kOuter, size.y + kOuter, kUpperFloor}, Finish::parquet, kOak);
  house.box({-kOuter, -kOuter, kRoom}, {12.07f, 11, kUpperFloor}, Finish::carpet, {0.38f, 0.42f, 0.48f});
  house.box({27.93f, -kOuter, kRoom}, {size.x + kOuter, 11, kUpperFloor}, Finish::carpet, {0.45f, 0.36f, 0.34f});
  house.box({12.07f, -kOuter, kRoom}, {27.93f, 0, kUpperFloor}, Finish::paint, kWhite);

  build_storey(house, 0);
  build_storey(house, kUpperFloor);
  build_hall(house);
  return std::move(house).solids();
}

}  // namespace stipple::scene
