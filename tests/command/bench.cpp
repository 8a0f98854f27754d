// `stipple bench` from end to end.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "render/method/method.h"
#include "tests/command/run_stipple.h"

namespace stipple::test::command_bench {
namespace {

namespace fs = std::filesystem;

std::string write_text(const ScratchFolder& folder, const std::string& text) {
  std::ofstream(folder.path("old.json")) << text;
  return folder.path("old.json");
}

constexpr std::size_t kParts =
    3 + 3 + 2 + 2 * 6;  // reading, building, processing; brute force and a frame's five for each rasterizer

// Without the qualities that methods reach.
std::size_t timed_parts(const Json& document) {
  return static_cast<std::size_t>(
      std::ranges::count_if(document.at("parts"), [](const Json& part) { return part.at("unit") != "points drawn"; }));
}

TEST(BenchCommand, TimesEveryPartOfATinyInput) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_stipple(folder, "bench " + city_file(folder, 3'000) + " --size 64x36 --budget 500 --repeat 2 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json document = Json::parse(outcome.out);
  ASSERT_EQ(timed_parts(document), kParts);
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
  for (const Json& part : document.at("parts")) {
    if (!contains(part.at("part").get<std::string>(), "tree on disk")) continue;
    double sum = 0.0;
    for (const Json& share : part.at("phase_shares")) sum += share.get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-9);
    EXPECT_GE(part.at("bytes_read").get<double>(), 2.0 * 3'000 * 12);  // positions at least, once to count
    EXPECT_GE(part.at("bytes_written").get<double>(), 3'000 * 12);
  }
  for (const char* key : {"version", "machine", "gl_renderer", "dataset", "size", "budget", "repeats"})
    EXPECT_TRUE(document.contains(key)) << key;
}

TEST(BenchCommand, ComparesWithAnEarlierRun) {
  const ScratchFolder folder;
  const std::string options = "bench " + city_file(folder, 2'000) + " --parts reading --size 16x9 --repeat 3 --json";
  const Outcome first = run_stipple(folder, options);
  ASSERT_EQ(first.code, 0) << first.err;
  Json old = Json::parse(first.out);
  for (Json& part : old.at("parts")) part["runs_ms"] = {1e6, 1e6, 1e6};  // no run takes as long
  const std::string path = write_text(folder, old.dump());
  const Outcome second = run_stipple(folder, options + " --compare " + path);
  ASSERT_EQ(second.code, 0) << second.err;
  const Json comparison = Json::parse(second.out).at("comparison");
  EXPECT_EQ(comparison.at("parts"), 3);
  EXPECT_EQ(comparison.at("moved").size(), 3);
  EXPECT_TRUE(comparison.at("differences").empty()) << comparison.dump();
}

TEST(BenchCommand, TellsWhatEachMethodTakesToAQuality) {
  const ScratchFolder folder;
  const std::string options =
      "bench " + city_file(folder, 3'000) + " --parts quality --size 64x36 --budget 500 --repeat 2";
  const Outcome first = run_stipple(folder, options + " --json");
  ASSERT_EQ(first.code, 0) << first.err;
  Json old = Json::parse(first.out);
  std::size_t identical = 0;
  for (Json& part : old.at("parts")) {
    EXPECT_EQ(part.at("unit"), "points drawn");
    EXPECT_EQ(part.at("runs_ms").size(), 2u);
    EXPECT_GT(part.at("amount").get<double>(), 0.0);
    if (part.at("part") == "brute-force to identical") {
      EXPECT_EQ(part.at("amount"), 3'000);
    }
    if (contains(part.at("part").get<std::string>(), "to identical")) ++identical;
    if (part.at("part") == "hybrid to identical") part["amount"] = 17.0;
  }
  EXPECT_GE(identical, 5u);  // all methods but lod
  const Outcome second = run_stipple(folder, options + " --json --compare " + write_text(folder, old.dump()));
  ASSERT_EQ(second.code, 0) << second.err;
  const Json moved = Json::parse(second.out).at("comparison").at("other_points");
  ASSERT_EQ(moved.size(), 1u) << moved.dump();
  EXPECT_EQ(moved[0].at("part"), "hybrid to identical");
  EXPECT_EQ(moved[0].at("old_points"), 17.0);
  const Outcome table = run_stipple(folder, options);
  EXPECT_TRUE(contains(table.out, "Time against error"));
  for (const Mode mode : all_modes()) EXPECT_TRUE(contains(table.out, fmt::format("\n{} ", name_of(mode))));
}

TEST(BenchCommand, RefusesToCompareWithAnythingElse) {
  const ScratchFolder folder;
  const std::string city = city_file(folder, 100);
  for (const char* text : {"{}", "[1, 2]", "no JSON", R"({"parts": 7})"}) {
    const Outcome outcome = run_stipple(
        folder, "bench " + city + " --parts reading --size 16x9 --repeat 1 --compare " + write_text(folder, text));
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_TRUE(contains(outcome.err, "old.json")) << outcome.err;
  }
  EXPECT_EQ(run_stipple(folder, "bench " + city + " --compare " + folder.path("none")).code, 1);
}

TEST(BenchCommand, AnEmptyFileHasParts) {
  const ScratchFolder folder;
  const std::string file = folder.write("empty.las", LasFile{.points = 0}.bytes());
  const Outcome outcome = run_stipple(folder, "bench " + file + " --size 16x9 --repeat 1 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(timed_parts(Json::parse(outcome.out)), kParts);
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
}  // namespace stipple::test::command_bench
