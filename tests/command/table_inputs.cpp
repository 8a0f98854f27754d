// PLY, PCD, OBJ and text through the whole program.
#include <fmt/format.h>

#include <cmath>

#include "tests/command/run_stipple.h"
#include "tests/read/read_fixture.h"

namespace stipple::test::command_table_inputs {
namespace {

class TableInputs : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  Outcome run(const std::string& arguments) const { return run_stipple(folder_, arguments); }
  Json json(const std::string& arguments) const {
    const Outcome outcome = run(arguments + " --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = outcome.out.substr(0, outcome.out.size() - 1);
    return Json::parse(text.starts_with("{\n") ? text : text.substr(text.rfind('\n') + 1));
  }

  // A wavy sheet of 20,000 points; every hundredth has no place when `holes`.
  std::string file(const std::string& kind, bool holes) const {
    constexpr int kPoints = 20'000;
    Binary binary;
    std::string text;
    for (int i = 0; i < kPoints; ++i) {
      const double x = i % 200 * 0.01, y = i / 200 * 0.01, z = std::sin(x * 7) * std::cos(y * 5);
      const bool hole = holes && i % 100 == 0;
      const int c[] = {i % 256, i / 256 % 256, 9};
      binary.put(static_cast<float>(hole ? NAN : x)).put(static_cast<float>(y)).put(static_cast<float>(z));
      for (const int channel : c) binary.put(static_cast<std::uint8_t>(channel));
      if (kind == "obj")
        text += fmt::format("v {:.3f} {:.3f} {} {:.3f} {:.3f} {:.3f}\n", x, y, hole ? "inf" : fmt::format("{:.4f}", z),
                            c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
      else
        text +=
            fmt::format("{:.3f} {:.3f} {} {} {} {}\n", x, y, hole ? "nan" : fmt::format("{:.4f}", z), c[0], c[1], c[2]);
    }
    const std::string count = std::to_string(kPoints);
    const std::string ply =
        " 1.0\nelement vertex " + count +
        "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
        "green\nproperty uchar blue\nend_header\n";
    std::string content = text;
    if (kind == "ply") content = "ply\nformat binary_little_endian" + ply + binary.bytes();
    if (kind == "ascii.ply") content = "ply\nformat ascii" + ply + text;
    if (kind == "pcd")
      content = "FIELDS x y z r g b\nSIZE 4 4 4 1 1 1\nTYPE F F F U U U\nPOINTS " + count + "\nDATA binary\n" +
                binary.bytes();
    return write_text(folder_, "sheet." + kind, content);
  }

  ScratchFolder folder_;
};

const char* const kKinds[] = {"ply", "ascii.ply", "pcd", "obj", "xyz"};

TEST_F(TableInputs, AreBuiltWholeAndCheckedAgainstThemselves) {
  for (const std::string kind : kKinds)
    for (const bool holes : {false, true}) {
      SCOPED_TRACE(kind);
      const std::string input = file(kind, holes);
      const std::uint64_t expected = holes ? 19'800 : 20'000;
      const Outcome build = run("build " + input + " -o " + path("tree") + " --force");
      ASSERT_EQ(build.code, 0) << build.err;
      EXPECT_EQ(build.err.find("200 of 20000 points have no finite position") != std::string::npos, holes) << build.err;
      const Json check = json("check " + path("tree") + " --against " + input);
      EXPECT_EQ(check.at("points"), expected);
      EXPECT_EQ(check.at("against").at("compared"), Json::parse(R"(["rgb"])"));
      EXPECT_EQ(check.at("against").at("largest_rounding"), 0.0);
      const Json info = json("info " + input);
      EXPECT_EQ(info.at("points"), expected);
      EXPECT_EQ(info.at("dropped_points"), 20'000 - expected);
    }
}

TEST_F(TableInputs, GiveTheSamePicture) {
  std::string first;
  for (const std::string kind : kKinds) {
    const std::string input = file(kind, true);
    const Outcome render = run("render " + input + " -o " + path(kind + ".png") +
                               " --mode reference --size 96x64 --eye 1,-1,1 --target 1,0.5,0 --point-size 2");
    ASSERT_EQ(render.code, 0) << render.err;
    EXPECT_TRUE(contains(render.err, "200 of 20000 points have no finite position"));
    if (first.empty()) first = path(kind + ".png");
    // Three decimals of the text make a pixel here and there another one
    const Outcome compare = run("compare " + path(kind + ".png") + " " + first + " --json");
    ASSERT_EQ(compare.code, 0) << compare.err;
    const Json db = Json::parse(compare.out).at("psnr_db");
    EXPECT_TRUE(!db.is_number() || db.get<double>() > 25.0) << kind << " " << db;
  }
}

TEST_F(TableInputs, JoinLasOnOneGrid) {
  const std::string text = write_text(folder_, "near.xyz", "565800.25 5934500.5 20.125\n565900.75 5934600 21\n");
  const std::string las = city_file(folder_, 10'000);
  ASSERT_EQ(run("build " + text + " " + las + " -o " + path("tree")).code, 0);
  const Json check = json("check " + path("tree") + " --against " + text + " " + las);
  EXPECT_EQ(check.at("points"), 10'002);
  EXPECT_EQ(check.at("against").at("largest_rounding"), 0.0);
}

TEST_F(TableInputs, FarFromOneAnotherAreRoundedAsCheckRoundsThem) {
  const std::string ply = file("ascii.ply", false);  // near the origin, which the city is not
  const std::string las = city_file(folder_, 10'000);
  const Outcome build = run("build " + ply + " " + las + " -o " + path("tree"));
  ASSERT_EQ(build.code, 0);
  EXPECT_TRUE(contains(build.err, "no common grid holds all files exactly"));
  EXPECT_GT(json("check " + path("tree") + " --against " + ply + " " + las).at("against").at("largest_rounding"), 0.0);
}

TEST_F(TableInputs, InfoNamesFormatVersionAndEncoding) {
  const std::pair<const char*, const char*> lines[] = {
      {"ply", "PLY 1.0\nencoding       binary little-endian, 15 bytes a point"},
      {"ascii.ply", "PLY 1.0\nencoding       ascii\n"},
      {"pcd", "PCD\nencoding       binary, 15 bytes a point"},
      {"obj", "OBJ\nencoding       text, vertices with colours"},
      {"xyz", "text\nencoding       columns x y z red green blue"}};
  for (const auto& [kind, line] : lines) {
    EXPECT_TRUE(contains(run("info " + file(kind, false)).out, line));
  }
}

}  // namespace
}  // namespace stipple::test::command_table_inputs
