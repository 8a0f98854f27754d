// `stipple study` from end to end.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "render/measure/image.h"
#include "tests/command/run_stipple.h"

namespace stipple::test {
namespace {

namespace fs = std::filesystem;

// A CSV file without quoted fields: a map from column to text for each row.
using Row = std::map<std::string, std::string>;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

std::vector<Row> rows_of(const std::string& path) {
  std::istringstream in(text_of(path));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = fields_of(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i) row[names[i]] = fields[i];
  }
  return rows;
}

class StudyCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  Outcome study(const std::string& arguments) const {
    return run_stipple(folder_, "study --size 160x90 --budget 4k " + arguments);
  }
  // A file with one view, so that a study is short.
  std::string one_view() const {
    std::ofstream(path("views.json"))
        << R"({"views": [{"name": "corner", "eye": [564900, 5933900, 200], "target": [565300, 5934300, 0]}]})";
    return path("views.json");
  }

  const ScratchFolder folder_;
};

TEST_F(StudyCommand, WritesCurvesThatRiseAndEndIdentical) {
  const std::string city = city_file(folder_, 20'000);
  const Outcome outcome = study(city + " -o " + path("out") + " --modes hierarchical,unstructured --repeat 2 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(Json::parse(outcome.out), document);
  EXPECT_EQ(document.at("views").size(), 3u);
  ASSERT_EQ(document.at("summary").size(), 6u);
  for (const Json& summary : document.at("summary")) {
    EXPECT_EQ(summary.at("identical_to_brute_force"), true);
    EXPECT_EQ(summary.at("converged"), true);
    EXPECT_EQ(summary.at("repeats"), 2);
    EXPECT_TRUE(summary.at("reached").at("identical").at("points").is_number());
  }
  for (const char* key : {"version", "machine", "gl_renderer", "settings", "datasets"})
    EXPECT_TRUE(document.contains(key)) << key;
  EXPECT_EQ(document.at("datasets").at(0).at("points_total"), 20'000);

  std::map<std::string, Row> before;
  for (Row& row : rows_of(path("out/curves.csv"))) {
    const std::string curve = row["view"] + row["mode"] + row["repeat"];
    if (before.contains(curve)) {
      EXPECT_EQ(std::stoi(row["frame"]), std::stoi(before[curve]["frame"]) + 1);
      EXPECT_GT(std::stoull(row["points_drawn"]), std::stoull(before[curve]["points_drawn"]));
      EXPECT_GE(std::stod(row["ms"]), std::stod(before[curve]["ms"]));
      EXPECT_GE(std::stoull(row["covered_pixels"]), std::stoull(before[curve]["covered_pixels"]));
    }
    before[curve] = row;
  }
  EXPECT_EQ(before.size(), 12u);
  for (auto& [curve, row] : before) {
    EXPECT_EQ(row["identical"] + row["converged"], "11") << curve;
    // Brute force on the GPU rounds otherwise than the reference: all but equal
    EXPECT_GT(std::stod(row["ssim"]), 0.95) << curve;
    EXPECT_LT(std::stod(row["flip"]), 0.05) << curve;
    for (const char* rate : {"hole", "see_through", "ghost"}) EXPECT_LT(std::stod(row[rate]), 0.02) << curve << rate;
  }

  EXPECT_TRUE(contains(text_of(path("out/plot.svg")), "</svg>"));
  for (const char* view : {"oblique", "aerial", "low"}) {
    EXPECT_EQ(read_png(path("out/reference/city/") + view + ".png").size, glm::ivec2(160, 90));
    for (const char* mode : {"hierarchical", "unstructured"})
      EXPECT_TRUE(fs::exists(path("out/frames/city/") + view + "/" + mode + "/00001.png")) << view << mode;
  }
}

TEST_F(StudyCommand, TwoRunsDifferInTheirTimesAlone) {
  const std::string arguments = city_file(folder_, 20'000) + " --views " + one_view() + " -o ";
  ASSERT_EQ(study(arguments + path("a")).code, 0);
  ASSERT_EQ(study(arguments + path("b")).code, 0);
  std::vector<Row> a = rows_of(path("a/curves.csv"));
  std::vector<Row> b = rows_of(path("b/curves.csv"));
  ASSERT_GT(a.size(), 5u);
  for (Row& row : a) row.erase("ms");
  for (Row& row : b) row.erase("ms");
  EXPECT_EQ(a, b);
}

TEST_F(StudyCommand, MeasuresFlipOfEveryFrameWhenAsked) {
  const std::string arguments = city_file(folder_, 20'000) + " --modes unstructured -o ";
  ASSERT_EQ(study(arguments + path("some")).code, 0);
  ASSERT_EQ(study(arguments + path("all") + " --flip-every-frame").code, 0);
  const std::vector<Row> some = rows_of(path("some/curves.csv"));
  const std::vector<Row> all = rows_of(path("all/curves.csv"));
  ASSERT_EQ(some.size(), all.size());
  EXPECT_FALSE(some.front().at("flip").empty());
  EXPECT_FALSE(some.back().at("flip").empty());
  for (std::size_t i = 0; i < all.size(); ++i) {
    // More points, less to see
    if (std::stoi(all[i].at("frame")) > 1) {
      EXPECT_LT(std::stod(all[i].at("flip")), std::stod(all[i - 1].at("flip"))) << i;
      EXPECT_LT(std::stod(all[i].at("hole")), std::stod(all[i - 1].at("hole"))) << i;
      EXPECT_GT(std::stod(all[i].at("ssim")), std::stod(all[i - 1].at("ssim"))) << i;
    }
    EXPECT_EQ(std::stod(all[i].at("ghost")), 0.0) << i;
    EXPECT_TRUE(some[i].at("flip").empty() || some[i].at("flip") == all[i].at("flip")) << i;
    const double wrong = std::stod(all[i].at("hole")) + std::stod(all[i].at("see_through")) +
                         std::stod(all[i].at("ghost")) + std::stod(all[i].at("wrong_point"));
    EXPECT_LE(wrong, 1.00001) << i;
  }
}

TEST_F(StudyCommand, AnInputThatFailsIsReportedAndTheRestGoOn) {
  const std::string city = city_file(folder_, 5'000);
  const Outcome outcome = study(city + " " + path("missing.las") + " " + city + " --modes unstructured --views " +
                                one_view() + " -o " + path("out"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "1 of 3 inputs failed"));
  EXPECT_TRUE(contains(outcome.err, path("missing.las")));
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(document.at("failures").size(), 1u);
  ASSERT_EQ(document.at("datasets").size(), 2u);
  // Two files of one name stay apart
  EXPECT_EQ(document.at("datasets").at(0).at("name"), "city");
  EXPECT_EQ(document.at("datasets").at(1).at("name"), "city-2");
  EXPECT_EQ(document.at("summary").size(), 2u);
  EXPECT_TRUE(fs::exists(path("out/frames/city-2/corner/unstructured/00001.png")));
}

TEST_F(StudyCommand, ACurveCutShortKeepsItsLastFrame) {
  const std::string city = city_file(folder_, 20'000);
  const Outcome cut = run_stipple(folder_, "study " + city + " --size 64x48 --modes unstructured --duration 0.05" +
                                               " --budget 1 --views " + one_view() + " -o " + path("out"));
  ASSERT_EQ(cut.code, 0) << cut.err;
  const std::vector<Row> rows = rows_of(path("out/curves.csv"));
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.back().at("converged"), "0");
  std::string last;
  for (const auto& entry : fs::directory_iterator(path("out/frames/city/corner/unstructured")))
    last = std::max(last, entry.path().stem().string());
  EXPECT_EQ(std::stoull(last), std::stoull(rows.back().at("frame")));
}

TEST_F(StudyCommand, WrongUsageNamesTheOption) {
  const std::string city = city_file(folder_, 100);
  for (const auto& [arguments, named] : std::map<std::string, std::string>{{"--modes best", "--modes best"},
                                                                           {"--raster crayons", "--raster crayons"},
                                                                           {"--duration 0", "--duration"},
                                                                           {"--repeat 0", "--repeat"},
                                                                           {"--color colour", "--color colour"},
                                                                           {"--fps 3", "--fps"}}) {
    const Outcome outcome = study(city + " -o " + path("out") + " " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(contains(outcome.err, named));
  }
  EXPECT_EQ(study("-o " + path("out")).code, 2);
}

TEST_F(StudyCommand, AFolderThatCannotBeMadeIsAFailureThatNamesIt) {
  const std::string city = city_file(folder_, 100);
  const Outcome outcome = study(city + " -o " + city + "/out");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, city + "/out"));
}

}  // namespace
}  // namespace stipple::test
