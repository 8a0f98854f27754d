#include "src/camera/camera_path.h"

#include <fstream>

#include "src/camera/camera_file.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::camera_path {
namespace {

CameraPath path_through(const std::vector<std::pair<double, glm::dvec3>>& eyes) {
  CameraPath path{"walk", {}};
  for (const auto& [seconds, eye] : eyes)
    path.keys.push_back({seconds, {.eye = eye, .target = eye + glm::dvec3(0, 100, 0)}});
  return path;
}

TEST(CameraPathTest, PassesThroughItsKeysAndStaysAtItsEnds) {
  const CameraPath path = path_through({{1.0, {0, 0, 5}}, {1.5, {3, 1, 5}}, {4.0, {4, 9, 2}}});
  for (const TimedCamera& key : path.keys)
    EXPECT_LT(glm::distance(camera_at(path, key.seconds).eye, key.camera.eye), 1e-12);
  EXPECT_EQ(camera_at(path, 0.0).eye, path.keys.front().camera.eye);
  EXPECT_EQ(camera_at(path, 9.0).eye, path.keys.back().camera.eye);
  EXPECT_EQ(path.duration(), 3.0);
}

TEST(CameraPathTest, MovesEvenlyBetweenTwoKeys) {
  CameraPath path = path_through({{0.0, {0, 0, 0}}, {2.0, {8, 0, 4}}});
  path.keys.back().camera.fov_deg = 30.0;
  for (const double t : {0.25, 0.5, 1.9})
    EXPECT_LT(glm::distance(camera_at(path, t).eye, glm::dvec3(4.0 * t, 0, 2.0 * t)), 1e-12) << t;
  EXPECT_DOUBLE_EQ(camera_at(path, 0.5).fov_deg, 52.5);
}

TEST(CameraPathTest, DoesNotJerkAtAKey) {
  const CameraPath path = path_through({{0.0, {0, 0, 0}}, {1.0, {1, 2, 0}}, {1.5, {5, 2, 1}}, {3.0, {5, 0, 0}}});
  constexpr double kStep = 1e-6;
  for (const double t : {1.0, 1.5}) {
    const glm::dvec3 before = (camera_at(path, t).eye - camera_at(path, t - kStep).eye) / kStep;
    const glm::dvec3 after = (camera_at(path, t + kStep).eye - camera_at(path, t).eye) / kStep;
    EXPECT_LT(glm::distance(before, after), 1e-3) << t;
  }
}

TEST(CameraPathTest, FollowsAParabolaExactly) {
  const auto place = [](double t) { return glm::dvec3(3.0 * t * t - t, t, -t * t); };
  const CameraPath path = path_through({{0, place(0)}, {1, place(1)}, {2.5, place(2.5)}, {3, place(3)}, {5, place(5)}});
  // Between inner keys, whose neighbours are all there
  for (const double t : {1.2, 2.0, 2.7}) EXPECT_LT(glm::distance(camera_at(path, t).eye, place(t)), 1e-12) << t;
}

TEST(CameraPathTest, IsCutIntoEvenSteps) {
  const CameraPath path = path_through({{2.0, {0, 0, 0}}, {4.0, {8, 0, 0}}});
  const std::vector<Camera> cameras = cameras_along(path, 5);
  ASSERT_EQ(cameras.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(cameras[i].eye.x, 2.0 * static_cast<double>(i), 1e-12);
  EXPECT_EQ(cameras_along(path, 1).front().eye.x, 0.0);
}

TEST(CameraPathTest, IsProposedFromTheFirstViewTowardsTheLast) {
  const NamedCamera outside{"oblique", {.eye = {0, 0, 100}, .target = {0, 100, 0}}};
  const NamedCamera inside{"low", {.eye = {0, 90, 2}, .target = {0, 200, 0}}};
  const CameraPath path = propose_path({outside, inside});
  EXPECT_EQ(path.keys.front().camera.eye, outside.camera.eye);
  EXPECT_EQ(path.keys.back().camera.eye, glm::dvec3(0, 45, 51));
  EXPECT_DOUBLE_EQ(path.duration(), 2.4);
}

class PathFile : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(folder_.path("path.json"), std::ios::binary) << text;
    return folder_.path("path.json");
  }
  void expect_error(const std::string& text, const Strings& parts) const {
    const std::string path = write(text);
    const std::string message = error_of([&] { read_camera_file(path); });
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
    for (const std::string& part : parts) EXPECT_TRUE(contains(message, part)) << message;
  }

 private:
  const ScratchFolder folder_;
};

TEST_F(PathFile, HoldsViewsAndPaths) {
  const std::string file = write(
      R"({"views": [{"name": "a", "eye": [0,0,0], "target": [1,0,0]}],
          "paths": [{"name": "walk", "cameras": [{"time": -1, "eye": [0,0,0], "target": [1,0,0]},
                                                 {"time": 2.5, "eye": [3,0,0], "target": [4,0,0], "fov_deg": 30}]},
                    {"cameras": [{"time": 0, "eye": [0,0,0], "target": [1,0,0]}]}]})");
  EXPECT_EQ(read_cameras(file).size(), 1u);
  const std::vector<CameraPath> paths = read_paths(file);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].name, "walk");
  EXPECT_EQ(paths[0].duration(), 3.5);
  EXPECT_EQ(paths[0].keys[1].camera.fov_deg, 30.0);
  EXPECT_EQ(paths[1].name, "path-2");
}

TEST_F(PathFile, WhatIsWrittenComesBackToTheLastBit) {
  const CameraPath path{"fl\xC3\xBCght",
                        {{1.0 / 3.0, {{500'000.123456789012, 5'300'000.987654321, 1.0 / 3.0}, {1, 2, 3}}},
                         {0.7, {{1, 2, 3}, {4, 5, 6}, {0.1, 0.2, 0.3}, 59.999999999999993}}}};
  const CameraPath back = read_paths(write(Json{{"paths", {json_of(path)}}}.dump())).front();
  EXPECT_EQ(back.name, path.name);
  ASSERT_EQ(back.keys.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.keys[i].seconds, path.keys[i].seconds);
    EXPECT_EQ(back.keys[i].camera.eye, path.keys[i].camera.eye);
    EXPECT_EQ(back.keys[i].camera.fov_deg, path.keys[i].camera.fov_deg);
  }
}

TEST_F(PathFile, WhatIsWrongIsNamedWithItsPlace) {
  const std::string camera = R"({"time": 1, "eye": [0,0,0], "target": [1,0,0]})";
  expect_error(R"({"paths": []})", {"\"paths\""});
  expect_error(R"({"paths": [{"cameras": []}]})", {"path 1", "\"cameras\""});
  expect_error(R"({"paths": [{"cameras": [3]}]})", {"path 1, camera 1", "\"time\""});
  expect_error(R"({"paths": [{"cameras": [{"eye": [0,0,0], "target": [1,0,0]}]}]})", {"path 1, camera 1", "\"time\""});
  expect_error(R"({"paths": [{"cameras": [{"time": 0, "eye": [0,0,0]}]}]})", {"path 1, camera 1", "\"target\""});
  expect_error("{\"paths\": [{\"cameras\": [" + camera + "," + camera + "]}]}",
               {"path 1, camera 2", "more than the 1"});
  expect_error(R"({"paths": [{"name": "a/b", "cameras": [)" + camera + "]}]}", {"path 1", "folder"});
}

TEST_F(PathFile, OneKindIsNotTakenForTheOther) {
  const std::string view = write(R"({"eye": [0,0,0], "target": [1,0,0]})");
  EXPECT_TRUE(contains(error_of([&] { read_paths(view); }), "\"paths\""));
  const std::string path = write(R"({"paths": [{"cameras": [{"time": 0, "eye": [0,0,0], "target": [1,0,0]}]}]})");
  EXPECT_TRUE(contains(error_of([&] { read_cameras(path); }), "\"views\""));
}

}  // namespace
}  // namespace stipple::test::camera_path
