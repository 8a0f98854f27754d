#include "src/camera/camera_file.h"

#include <fstream>

#include "tests/octree/las_fixture.h"

namespace stipple::test::camera_file {
namespace {

class CameraFile : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(folder_.path("camera.json"), std::ios::binary) << text;
    return folder_.path("camera.json");
  }
  std::vector<NamedCamera> read(const std::string& text) const { return read_cameras(write(text)); }
  // The message holds the path and all parts.
  void expect_error(const std::string& text, const Strings& parts) const {
    const std::string path = write(text);
    const std::string message = error_of([&] { read_cameras(path); });
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
    for (const std::string& part : parts) EXPECT_TRUE(contains(message, part)) << text;
  }

 private:
  const ScratchFolder folder_;
};

TEST_F(CameraFile, HoldsOneViewOrAList) {
  const auto one = read(R"({"eye": [1, 2.5, -3], "target": [4, 5, 6]})");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].name, "view-1");
  EXPECT_EQ(one[0].camera.eye, glm::dvec3(1, 2.5, -3));
  EXPECT_EQ(one[0].camera.target, glm::dvec3(4, 5, 6));
  EXPECT_EQ(one[0].camera.up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(one[0].camera.fov_deg, 60.0);

  const auto list = read(R"({"views": [{"name": "a", "eye": [0,0,0], "target": [1,0,0], "up": [0,1,0], "fov_deg": 30},
                                       {"eye": [0,0,0], "target": [1,0,0]}]})");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "a");
  EXPECT_EQ(list[0].camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(list[0].camera.fov_deg, 30.0);
  EXPECT_EQ(list[1].name, "view-2");
}

TEST_F(CameraFile, WhatIsWrittenComesBackToTheLastBitAtUtmMagnitude) {
  NamedCamera named{"a \"quoted\" n\xC3\xA4me", {}};
  named.camera = {{500'000.123456789012, 5'300'000.987654321, 1.0 / 3.0},
                  {499'999.1, 5'300'001.7, -0.1},
                  {0.1, 0.2, 0.3},
                  59.999999999999993};
  const auto back = read(json_of(named).dump());
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].name, named.name);
  EXPECT_EQ(back[0].camera.eye, named.camera.eye);
  EXPECT_EQ(back[0].camera.target, named.camera.target);
  EXPECT_EQ(back[0].camera.up, named.camera.up);
  EXPECT_EQ(back[0].camera.fov_deg, named.camera.fov_deg);
}

TEST_F(CameraFile, MissingKeysAreNamedWithTheirView) {
  expect_error(R"({"target": [0,0,0]})", {"view 1", "\"eye\"", "[x, y, z]"});
  expect_error(R"({"views": [{"eye": [0,0,0], "target": [1,0,0]}, {"eye": [0,0,0]}]})", {"view 2", "\"target\""});
}

TEST_F(CameraFile, WrongTypesAreNamedWithWhatIsThere) {
  expect_error(R"({"eye": "0,0,9", "target": [0,0,0]})", {"\"eye\"", "\"0,0,9\"", "three numbers"});
  expect_error(R"({"eye": [1, 2], "target": [0,0,0]})", {"\"eye\"", "[1,2]"});
  expect_error(R"({"eye": [1, 2, null], "target": [0,0,0]})", {"\"eye\"", "[1,2,null]"});
  expect_error(R"({"eye": [1, 2, 3], "target": [0,0,0], "up": 3})", {"\"up\""});
  expect_error(R"({"eye": [1, 2, 3], "target": [0,0,0], "fov_deg": "60"})", {"\"fov_deg\"", "degrees"});
  expect_error(R"({"eye": [1, 2, 3], "target": [0,0,0], "name": 7})", {"\"name\""});
  expect_error(R"({"eye": [1, 2, 3], "target": [0,0,0], "name": ""})", {"\"name\""});
  expect_error(R"([1, 2])", {"view 1", "object"});
  expect_error(R"({"views": []})", {"\"views\""});
  expect_error(R"({"views": {"eye": [1,2,3]}})", {"\"views\""});
  expect_error(R"({"views": [5]})", {"view 1", "object"});
}

TEST_F(CameraFile, NamesMustBeFoldersAndDiffer) {
  for (const char* name : {"a/b", ".", "..", ".hidden", "/"})
    expect_error(R"({"eye": [1,2,3], "target": [0,0,0], "name": ")" + std::string(name) + "\"}", {"folder"});
  expect_error(R"({"eye": [1,2,3], "target": [0,0,0], "name": "a\u0000b"})", {"folder"});
  const std::string view = R"({"name": "a", "eye": [1,2,3], "target": [0,0,0]})";
  expect_error("{\"views\": [" + view + "," + view + "]}", {"view 2", "\"a\""});
}

TEST_F(CameraFile, WhatIsNoJsonIsNamedWithItsByte) {
  expect_error("", {"at byte"});
  expect_error("eye = 0,0,0", {"at byte 1", "JSON"});
  expect_error(R"({"eye": [1, 2, 3], "target" [0,0,0]})", {"at byte 29"});
  expect_error("{\"eye\": [1,2,3], \"target\": [0,0,0], \"name\": \"\xFF\"}", {"at byte"});
}

TEST_F(CameraFile, NumbersBeyondDoubleAreAnErrorOfTheFile) {
  expect_error(R"({"eye": [1e999, 2, 3], "target": [0,0,0]})", {"1e999"});
}

TEST_F(CameraFile, AMissingFileIsNamed) {
  const ScratchFolder folder;
  EXPECT_TRUE(contains(error_of([&] { read_cameras(folder.path("none.json")); }), folder.path("none.json")));
}

}  // namespace
}  // namespace stipple::test::camera_file
