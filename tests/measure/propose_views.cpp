#include "render/frame/propose_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "render/store/dataset.h"

namespace stipple::test::measure_propose_views {
namespace {

PointSet points_at(const std::vector<glm::ivec3>& positions, const Grid& grid) {
  PointSet set;
  set.grid = grid;
  for (const glm::ivec3& p : positions) {
    set.bounds.extend(p);
    set.points.push_back({p, 0xFFFFFFFFu});
  }
  return set;
}

const Grid kMillimetres{glm::dvec3(5e5, 5.3e6, 100), glm::dvec3(0.001)};

// Points anywhere in a box of this many cells.
PointSet box_of_points(const glm::ivec3& extent, std::size_t count, const Grid& grid = kMillimetres) {
  std::mt19937 random(1);
  std::vector<glm::ivec3> positions;
  for (std::size_t i = 0; i < count; ++i) {
    glm::ivec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::uniform_int_distribution<int>(0, extent[axis])(random);
    positions.push_back(p);
  }
  return points_at(positions, grid);
}

// How many points are in the picture, and how much of its width or height they take, whichever is more.
struct Framing {
  std::size_t inside = 0;
  double extent = 0.0;
};

Framing framing_of(const PointSet& set, const Camera& camera, double aspect) {
  const View view = make_view(camera, {static_cast<int>(1000 * aspect), 1000}, near_plane(set.grid));
  Framing framing;
  glm::dvec2 low(1.0);
  glm::dvec2 high(-1.0);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const glm::dvec3 r = set.grid.world_from_grid(set.points[i].position) - view.eye;
    const double depth = glm::dot(view.forward, r);
    if (depth <= view.near) continue;
    const glm::dvec2 place(glm::dot(view.right, r) * view.cot_x / depth, glm::dot(view.up, r) * view.cot_y / depth);
    if (std::max(std::abs(place.x), std::abs(place.y)) >= 1.0) continue;
    ++framing.inside;
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  framing.extent = 0.5 * std::max(high.x - low.x, high.y - low.y);
  return framing;
}

Camera camera_named(const std::vector<NamedCamera>& cameras, const std::string& name) {
  for (const NamedCamera& named : cameras)
    if (named.name == name) return named.camera;
  ADD_FAILURE() << "no camera " << name;
  return {};
}

constexpr const char* kWhole[] = {"oblique", "aerial"};

TEST(ProposeCameras, GivesObliqueAerialAndLow) {
  const auto cameras = propose_cameras(box_of_points({9, 9, 9}, 10), 1.5);
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[0].name, "oblique");
  EXPECT_EQ(cameras[1].name, "aerial");
  EXPECT_EQ(cameras[2].name, "low");
}

TEST(ProposeCameras, ShowTheWholeCloudAndFillThePictureAtAnyAspect) {
  for (const glm::ivec3 extent : {glm::ivec3(90'000, 90'000, 20'000), {500'000, 3'000, 3'000}, {1'000, 2'000, 400'000}})
    for (const double aspect : {0.25, 0.5, 1.0, 16.0 / 9.0, 4.0}) {
      const PointSet set = box_of_points(extent, 5'000);
      for (const char* name : kWhole) {
        const Framing framing = framing_of(set, camera_named(propose_cameras(set, aspect), name), aspect);
        EXPECT_GE(framing.inside, set.size() * 97 / 100) << name << " " << aspect;
        EXPECT_GT(framing.extent, 0.25) << name << " " << aspect;
      }
    }
}

TEST(ProposeCameras, StrayPointsDoNotCount) {
  PointSet set = box_of_points({90'000, 90'000, 20'000}, 5'000);
  const auto before = propose_cameras(set, 1.5);
  for (int i = 0; i < 10; ++i) set.points.push_back({{2'000'000'000, -2'000'000'000, i * 100'000'000}, 0});
  for (const char* name : kWhole) {
    const Framing framing = framing_of(set, camera_named(propose_cameras(set, 1.5), name), 1.5);
    EXPECT_GT(framing.extent, 0.5) << name;
    EXPECT_GE(framing.inside, 4'850u) << name;
  }
}

TEST(ProposeCameras, OfAFewPointsNoneIsStray) {
  for (int count = 2; count <= 40; ++count) {
    std::vector<glm::ivec3> positions;
    for (int i = 0; i < count; ++i) positions.push_back({i * 1'000, i * i * 300, i * 500});
    const PointSet set = points_at(positions, kMillimetres);
    for (const char* name : kWhole) {
      const Framing framing = framing_of(set, camera_named(propose_cameras(set, 1.5), name), 1.5);
      EXPECT_EQ(framing.inside, set.size()) << name;
    }
  }
}

TEST(ProposeCameras, DoNotDependOnTheOrderOfThePoints) {
  // Columns of points above each other and duplicates: many at equal distances
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 3'000; ++i) positions.push_back({i % 10 * 1'000, i / 10 % 10 * 1'000, i / 100 % 20 * 777});
  const PointSet set = points_at(positions, kMillimetres);
  const auto expected = propose_cameras(set, 1.5);
  std::vector<std::uint32_t> order(set.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    PointSet shuffled = set;
    shuffled.ids.assign(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) shuffled.points[i] = set.points[order[i]];
    const auto cameras = propose_cameras(shuffled, 1.5);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      EXPECT_EQ(cameras[c].camera.eye, expected[c].camera.eye) << cameras[c].name;
      EXPECT_EQ(cameras[c].camera.target, expected[c].camera.target) << cameras[c].name;
    }
  }
}

TEST(ProposeCameras, AnEmptyCloudGivesCamerasThatWork) {
  for (const NamedCamera& named : propose_cameras(PointSet{}, 1.5)) {
    EXPECT_NO_THROW(make_view(named.camera, {150, 100}, 1e-3)) << named.name;
    EXPECT_LT(glm::length(named.camera.eye), 100.0) << named.name;
  }
}

TEST(ProposeCameras, PointsWithoutExtentAreInThePicture) {
  // Nothing, a line along each axis, a diagonal, on grids from fine to coarse
  const std::vector<std::vector<glm::ivec3>> clouds{{{5, 6, 7}},
                                                    {{5, 6, 7}, {5, 6, 7}},
                                                    {{0, 0, 0}, {9, 0, 0}},
                                                    {{0, 0, 0}, {0, 9, 0}},
                                                    {{0, 0, 0}, {0, 0, 9}},
                                                    {{0, 0, 0}, {1, 1, 1}}};
  for (const double scale : {1e-7, 0.001, 1.0, 100.0})
    for (std::size_t c = 0; c < clouds.size(); ++c) {
      const PointSet set = points_at(clouds[c], {glm::dvec3(10, 20, 30), glm::dvec3(scale)});
      for (const NamedCamera& named : propose_cameras(set, 1.5))
        EXPECT_NO_THROW(make_view(named.camera, {150, 100}, near_plane(set.grid))) << named.name;
      for (const char* name : kWhole)
        EXPECT_EQ(framing_of(set, camera_named(propose_cameras(set, 1.5), name), 1.5).inside, set.size())
            << name << ", cloud " << c << ", scale " << scale;
    }
}

TEST(ProposeCameras, DegreesBesideMetresAreNotClippedAway) {
  // Longitude and latitude on a fine grid, height in metres on a coarse one
  const PointSet set = box_of_points({500'000, 500'000, 0}, 2'000, {glm::dvec3(0), glm::dvec3(1e-7, 1e-7, 0.01)});
  for (const char* name : kWhole)
    EXPECT_GT(framing_of(set, camera_named(propose_cameras(set, 1.5), name), 1.5).inside, 1'900u) << name;
}

TEST(ProposeCameras, LowStandsOutsideOfTheGroundAndSeesPartOfIt) {
  const PointSet set = box_of_points({90'000, 90'000, 500}, 20'000);
  const Camera low = camera_named(propose_cameras(set, 1.5), "low");
  EXPECT_GT(low.eye.z, set.grid.world_from_grid(set.bounds.max).z);
  EXPECT_GT(framing_of(set, low, 1.5).inside, 1'000u);
}

}  // namespace
}  // namespace stipple::test::measure_propose_views
