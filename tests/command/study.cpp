// `stipple study` from end to end.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "render/measure/image.h"
#include "tests/command/run_stipple.h"

namespace stipple::test::command_study {
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
    return run_stipple(folder_, "study --size 160x90 --budget 4k --regime cold " + arguments);
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
  for (const char* key : {"version", "machine", "gl_renderer", "gl_atomic_bits", "settings", "datasets"})
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
      EXPECT_TRUE(fs::exists(path("out/frames/city/cold/") + view + "/" + mode + "/00001.png")) << view << mode;
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

// Every regime of two views and a path, on the clock that counts points.
class StudyRegimes : public StudyCommand {
 protected:
  StudyRegimes() : city_(city_file(folder_, 20'000)) {
    std::ofstream(path("cameras.json"))
        << R"({"views": [{"name": "corner", "eye": [564900, 5933900, 200], "target": [565300, 5934300, 0]},
                         {"name": "top", "eye": [565250, 5934200, 900], "target": [565300, 5934300, 0]}],
               "paths": [{"name": "walk", "cameras": [
                 {"time": 0, "eye": [564900, 5933900, 200], "target": [565300, 5934300, 0]},
                 {"time": 2, "eye": [565000, 5934000, 150], "target": [565300, 5934300, 0], "fov_deg": 50}]}]})";
  }
  Outcome regimes(const std::string& output, const std::string& more = "") const {
    return run_stipple(folder_, "study --size 160x90 --budget 4k --regime cold,jump,path,stop,loading --clock points " +
                                    city_ + " --views " + path("cameras.json") + " --path " + path("cameras.json") +
                                    " --path-frames 6 -o " + path(output) + " " + more);
  }

  const std::string city_;
};

TEST_F(StudyRegimes, TwoRunsOnThePointsClockAreIdentical) {
  ASSERT_EQ(regimes("a").code, 0);
  ASSERT_EQ(regimes("b").code, 0);
  EXPECT_EQ(text_of(path("a/curves.csv")), text_of(path("b/curves.csv")));
  EXPECT_FALSE(contains(text_of(path("a/plot.svg")), "milliseconds"));
}

TEST_F(StudyRegimes, EachErrorHasItsCause) {
  ASSERT_EQ(regimes("out").code, 0);
  std::map<std::string, int> frames;
  std::map<std::string, double> carry;
  for (const Row& row : rows_of(path("out/curves.csv"))) {
    const std::string curve = row.at("regime") + " " + row.at("mode");
    EXPECT_EQ(row.at("ms"), "");
    EXPECT_EQ(row.at("V"), "1");
    const double mse = std::stod(row.at("mse"));
    const double parts =
        std::stod(row.at("mse_rounding")) + std::stod(row.at("mse_selection")) + std::stod(row.at("mse_carry"));
    EXPECT_NEAR(parts, mse, 1e-6 * mse + 1e-9) << curve;
    // Nothing gets lost while the camera stands still, or where everything is drawn anew
    if (row.at("regime") == "cold" || row.at("mode") == "brute-force") {
      EXPECT_EQ(row.at("mse_carry"), "0") << curve;
    }
    if (row.at("mode") == "brute-force") {
      EXPECT_EQ(row.at("reuse"), "");
      EXPECT_EQ(row.at("R"), "0");
      EXPECT_EQ(row.at("identical"), "1");
    } else if (row.at("regime") == "path" && row.at("frame") != "1" && row.at("mode") != "lod" &&
               row.at("mode") != "subsample") {
      EXPECT_GT(std::stod(row.at("reuse")), 0.2) << curve;
      EXPECT_GT(std::stoi(row.at("R")), 0) << curve;
      EXPECT_FALSE(row.at("flicker").empty());
      EXPECT_FALSE(row.at("flip").empty());
    }
    ++frames[curve];
    carry[curve] += std::stod(row.at("mse_carry"));
  }
  EXPECT_EQ(frames.size(), 4u * 6u + 2u);
  for (const char* mode : {"hierarchical", "unstructured", "hybrid"}) {
    EXPECT_EQ(frames[std::string("path ") + mode], 6);
    EXPECT_GT(carry[std::string("path ") + mode], 0.0) << mode;
  }
}

TEST_F(StudyRegimes, WhileLoadingThePictureFillsWithWhatIsRead) {
  ASSERT_EQ(regimes("out").code, 0);
  std::map<std::string, Row> last;
  for (const Row& row : rows_of(path("out/curves.csv"))) {
    EXPECT_EQ(row.at("points_loaded").empty(), row.at("regime") != "loading");
    if (row.at("regime") != "loading") continue;
    EXPECT_EQ(std::stoi(row.at("points_loaded")), std::min(20'000, 4'000 * std::stoi(row.at("frame"))));
    last[row.at("mode") + " " + row.at("view")] = row;
  }
  EXPECT_EQ(last.size(), 2u * 2u);  // unstructured and hybrid
  for (const auto& [curve, row] : last) EXPECT_EQ(row.at("identical"), "1") << curve;
  const Json study = json_file(path("out/study.json"));
  for (const Json& row : study.at("summary")) {
    EXPECT_EQ(row.at("loaded").is_null(), row.at("regime") != "loading");
    if (row.at("regime") == "loading") {
      // Five frames of 4,000 points; hybrid may find that some of them cannot be seen
      const auto points = row.at("loaded").at("points").get<int>();
      EXPECT_LE(points, 20'000);
      EXPECT_GE(points, row.at("mode") == "unstructured" ? 20'000 : 19'000);
    }
  }
  EXPECT_EQ(regimes("other", "--modes lod,hierarchical").code, 2);
}

// By the wall clock the file is read once more.
TEST_F(StudyRegimes, WhileLoadingByTheWallClock) {
  ASSERT_EQ(run_stipple(folder_, "study --size 160x90 --budget 4k --regime loading " + city_ + " --views " +
                                     path("cameras.json") + " -o " + path("out"))
                .code,
            0);
  double before = 0.0;
  for (const Row& row : rows_of(path("out/curves.csv"))) {
    if (row.at("frame") == "1") before = 0.0;
    EXPECT_GT(std::stod(row.at("ms")), before);
    before = std::stod(row.at("ms"));
    if (row.at("converged") == "1") {
      EXPECT_EQ(row.at("identical"), "1");
    }
  }
}

TEST_F(StudyRegimes, AfterAJumpOrAStopThePictureIsBuiltOnTheLast) {
  ASSERT_EQ(regimes("out", "--modes unstructured").code, 0);
  std::map<std::string, Row> first;
  std::map<std::string, Row> last;
  for (const Row& row : rows_of(path("out/curves.csv"))) {
    const std::string curve = row.at("regime") + " " + row.at("view");
    first.emplace(curve, row);
    last[curve] = row;
  }
  EXPECT_LT(std::stod(first["jump corner"]["mse"]), std::stod(first["cold corner"]["mse"]));
  EXPECT_LT(std::stod(first["stop walk"]["mse"]), std::stod(last["path walk"]["mse"]));
  for (const char* curve : {"jump corner", "jump top", "stop walk"}) {
    EXPECT_GT(std::stod(first[curve]["reuse"]), 0.0) << curve;
    EXPECT_EQ(last[curve]["identical"], "1") << curve;
  }
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(document.at("paths").at(0).at("frames"), 6);
  EXPECT_EQ(read_png(path("out/reference/city/walk/00006.png")).size, glm::ivec2(160, 90));
  for (const char* raster : {"compute", "points"})
    EXPECT_TRUE(document.at("views").at(0).at("rounding").at(raster).at("mse").is_number()) << raster;
}

TEST_F(StudyRegimes, ResumesWhereItWasInterrupted) {
  ASSERT_EQ(regimes("out").code, 0);
  const std::string curves = text_of(path("out/curves.csv"));
  // As if the program had died while it wrote its tenth line
  std::istringstream in(text_of(path("out/finished.jsonl")));
  std::string kept;
  std::string line;
  for (int i = 0; i < 9 && std::getline(in, line); ++i) kept += line + '\n';
  std::ofstream(path("out/finished.jsonl"), std::ios::binary | std::ios::trunc) << kept << R"({"key": "half)";
  std::filesystem::remove(path("out/curves.csv"));

  const Outcome outcome = regimes("out", "--resume");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(text_of(path("out/curves.csv")), curves);
  EXPECT_FALSE(contains(outcome.err, "cold, corner: brute-force"));
  EXPECT_TRUE(contains(outcome.err, "[40/40]"));
  const Outcome other = regimes("out", "--resume --seed 5");
  EXPECT_EQ(other.code, 1);
  EXPECT_TRUE(contains(other.err, "seed is 5, was 0"));
}

TEST_F(StudyRegimes, AMethodThatFailsIsReportedAndTheRestGoOn) {
  ASSERT_EQ(run_stipple(folder_, "build " + city_ + " -o " + path("tree")).code, 0);
  const Outcome outcome = run_stipple(
      folder_, "study " + path("tree") +
                   " --size 64x48 --budget 4k --clock points --modes hierarchical,unstructured -o " + path("out"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "tree, cold, oblique, hierarchical: "));
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(document.at("failures").size(), 4u);
  EXPECT_EQ(document.at("complete"), false);
  ASSERT_EQ(document.at("summary").size(), 4u);
  for (const Json& summary : document.at("summary")) EXPECT_EQ(summary.at("mode"), "unstructured");
  EXPECT_TRUE(contains(text_of(path("out/index.html")), "tree, cold, oblique, hierarchical: "));
}

TEST_F(StudyRegimes, PicturesCarryWhatItTakesToRepeatThem) {
  ASSERT_EQ(regimes("out", "--modes hybrid").code, 0);
  const std::string hash = json_file(path("out/study.json")).at("datasets").at(0).at("points_hash");
  for (const char* file : {"reference/city/corner.png", "frames/city/jump/corner/hybrid/00001.png"}) {
    const std::string picture = text_of(path("out/") + file);
    for (const std::string& part : {hash, std::string("\"eye\""), std::string("\"mode\":")})
      EXPECT_TRUE(contains(picture, part)) << file;
  }
  const std::string moving = text_of(path("out/frames/city/path/walk/hybrid/00001.png"));
  for (const char* part : {"\"path_frames\":6", "\"time\":2.0", "\"seed\":0", "\"version\":"})
    EXPECT_TRUE(contains(moving, part)) << part;
}

TEST_F(StudyRegimes, ASignalEndsItWithWhatIsFinished) {
  // A point a frame takes longer than anybody waits
  const std::string command = std::string(STIPPLE_PROGRAM) + " study " + city_ +
                              " --size 64x48 --budget 1 --regime cold" + " --modes brute-force,unstructured --views " +
                              one_view() + " -o " + path("out") + " >" + path("table") + " 2>" + path("log") +
                              " & p=$!; until grep -qs unstructured " + path("log") +
                              "; do sleep 0.1; done; kill -TERM $p; wait $p";
  const int status = std::system(("sh -c '" + command + "'").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(contains(text_of(path("log")), "--resume"));
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(document.at("complete"), false);
  ASSERT_EQ(document.at("summary").size(), 1u);
  EXPECT_EQ(document.at("summary").at(0).at("mode"), "brute-force");
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
  EXPECT_TRUE(contains(outcome.err, "this failed"));
  EXPECT_TRUE(contains(outcome.err, path("missing.las")));
  const Json document = json_file(path("out/study.json"));
  EXPECT_EQ(document.at("failures").size(), 1u);
  ASSERT_EQ(document.at("datasets").size(), 2u);
  // Two files of one name stay apart
  EXPECT_EQ(document.at("datasets").at(0).at("name"), "city");
  EXPECT_EQ(document.at("datasets").at(1).at("name"), "city-2");
  EXPECT_EQ(document.at("summary").size(), 2u);
  EXPECT_TRUE(fs::exists(path("out/frames/city-2/cold/corner/unstructured/00001.png")));
}

TEST_F(StudyCommand, ACurveCutShortKeepsItsLastFrame) {
  const std::string city = city_file(folder_, 20'000);
  const Outcome cut =
      run_stipple(folder_, "study " + city + " --size 64x48 --regime cold --modes unstructured --duration 0.05" +
                               " --budget 1 --views " + one_view() + " -o " + path("out"));
  ASSERT_EQ(cut.code, 0) << cut.err;
  const std::vector<Row> rows = rows_of(path("out/curves.csv"));
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.back().at("converged"), "0");
  std::string last;
  for (const auto& entry : fs::directory_iterator(path("out/frames/city/cold/corner/unstructured")))
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
                                                                           {"--fps 3", "--fps"},
                                                                           {"--steer gpu", "--steer"},
                                                                           {"--regime fast", "--regime fast"},
                                                                           {"--clock sun", "--clock sun"},
                                                                           {"--path-frames 1", "--path-frames"}}) {
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
}  // namespace stipple::test::command_study
