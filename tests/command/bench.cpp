// `stipple bench` from end to end.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/command/run_stipple.h"

namespace stipple::test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kParts = 5 + 2 * 6;  // reading, processing; brute force and a frame's five for each rasterizer

TEST(BenchCommand, TimesEveryPartOfATinyInput) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_stipple(folder, "bench " + city_file(folder, 3'000) + " --size 64x36 --budget 500 --repeat 2 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json document = Json::parse(outcome.out);
  ASSERT_EQ(document.at("parts").size(), kParts);
  std::string names;
  for (const Json& part : document.at("parts")) {
    names += part.at("part").get<std::string>() + "\n";
    EXPECT_GT(part.at("median_ms").get<double>(), 0.0);
    EXPECT_LE(part.at("min_ms").get<double>(), part.at("median_ms").get<double>());
    EXPECT_LE(part.at("median_ms").get<double>(), part.at("max_ms").get<double>());
    EXPECT_GT(part.at("amount").get<double>(), 0.0) << part.at("part");
  }
  for (const char* name :
       {"read LAS", "load LAS", "build octree", "reference", "points: brute force", "points: reproject, screen grid",
        "compute: brute force", "compute: reproject, vertices", "compute: fill", "compute: prepare"})
    EXPECT_TRUE(contains(names, name));
  for (const char* key : {"version", "machine", "gl_renderer", "dataset", "size", "budget", "repeats"})
    EXPECT_TRUE(document.contains(key)) << key;
}

TEST(BenchCommand, AnEmptyFileHasParts) {
  const ScratchFolder folder;
  const std::string file = folder.write("empty.las", LasFile{.points = 0}.bytes());
  const Outcome outcome = run_stipple(folder, "bench " + file + " --size 16x9 --repeat 1 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("parts").size(), kParts);
}

TEST(BenchCommand, AGeneratedCityIsGoneAfterwards) {
  const ScratchFolder folder;
  const Outcome outcome = run_stipple(folder, "bench --points 2k --size 16x9 --repeat 1 --json");
  EXPECT_TRUE(outcome.out.starts_with("{")) << outcome.err;
  const fs::path temporary = fs::temp_directory_path();
  const std::string path = Json::parse(outcome.out).at("dataset").at("path");
  EXPECT_TRUE(contains(path, temporary.string()));
  EXPECT_FALSE(fs::exists(path));
}

TEST(BenchCommand, WrongUsageNamesTheOption) {
  const ScratchFolder folder;
  const std::string city = city_file(folder, 100);
  EXPECT_EQ(run_stipple(folder, "bench " + city + " --points 1k").code, 2);
  const Outcome outcome = run_stipple(folder, "bench " + city + " --repeat 0");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "--repeat"));
  EXPECT_TRUE(contains(run_stipple(folder, "bench " + city + " --size big").err, "--size"));
}

}  // namespace
}  // namespace stipple::test
