// Runs the built program. Each run is slow under sanitizers: a handful of them, each asking several things.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "render/measure/image.h"
#include "src/cli/cli.h"
#include "src/json/json.h"

namespace stipple::test::command_program {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Program : public testing::Test {
 protected:
  Program() { fs::create_directories(folder_); }
  ~Program() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Outcome run(const std::string& arguments) const {
    Outcome outcome;
    const std::string command = std::string(STIPPLE_PROGRAM) + " " + arguments + " 2> " + path("stderr");
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
      outcome.out.append(buffer.data(), count);
    const int status = ::pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.err = text_of(path("stderr"));
    return outcome;
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("stipple-program-" + std::to_string(::getpid()));
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Image grey(int width, std::uint8_t value) {
  return {{width, 2}, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * 6, value)};
}

TEST_F(Program, WithoutACommandShowsHelpAndIsWrongUsage) {
  const Outcome outcome = run("");
  EXPECT_EQ(outcome.code, 2);
  for (const char* command : {"info", "compare", "scene"}) EXPECT_TRUE(holds(outcome.err, command)) << outcome.err;
}

TEST_F(Program, SaysItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, std::string(version()) + "\n");
}

TEST_F(Program, WrongUsageNamesTheOptionAndWhereToLook) {
  const Outcome unknown = run("compare --colour");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(holds(unknown.err, "--colour")) << unknown.err;
  EXPECT_TRUE(holds(unknown.err, "`stipple compare --help`")) << unknown.err;
  EXPECT_EQ(unknown.out, "");
  const Outcome bad_value = run("scene city -o " + path("a.las") + " --points many");
  EXPECT_EQ(bad_value.code, 2);
  EXPECT_TRUE(holds(bad_value.err, "--points: \"many\"")) << bad_value.err;
  EXPECT_EQ(run("scene city -o " + path("a.las") + " --seed -3").code, 2);
  EXPECT_FALSE(fs::exists(path("a.las")));
}

TEST_F(Program, FailedWorkIsOneMessageThatNamesTheFile) {
  const Outcome outcome = run("info " + path("missing.las") + " --json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("stipple: ")) << outcome.err;
  EXPECT_TRUE(holds(outcome.err, path("missing.las"))) << outcome.err;
}

TEST_F(Program, FullDiskBehindStdoutIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  EXPECT_EQ(run("--version > /dev/full").code, 1);
}

TEST_F(Program, ComparePrintsPsnrAndDifferences) {
  write_png(path("a.png"), grey(4, 100));
  write_png(path("b.png"), grey(4, 110));
  const Outcome outcome = run("compare " + path("a.png") + " " + path("b.png") + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_NEAR(json.at("psnr_db").get<double>(), 28.1308, 1e-4);
  EXPECT_EQ(json.at("mse"), 100.0);
  EXPECT_EQ(json.at("different_pixels"), 8);
  EXPECT_EQ(json.at("largest_difference"), 10);
}

TEST_F(Program, CompareMeasuresSimilarityAndWhatIsSeen) {
  // Two rows of pixels: too few for a window of SSIM
  write_png(path("a.png"), grey(12, 100));
  write_png(path("b.png"), grey(12, 110));
  const Outcome flat = run("compare " + path("a.png") + " " + path("b.png") + " --json");
  EXPECT_TRUE(Json::parse(flat.out).at("ssim").is_null()) << flat.out;
  EXPECT_TRUE(holds(run("compare " + path("a.png") + " " + path("b.png")).out, "needs 11x11 pixels"));
  Image square{{12, 12}, std::vector<std::uint8_t>(12 * 12 * 3, 100)};
  write_png(path("c.png"), square);
  std::ranges::fill(square.rgb, std::uint8_t{110});
  write_png(path("d.png"), square);
  const Json json = Json::parse(run("compare " + path("c.png") + " " + path("d.png") + " --json").out);
  EXPECT_NEAR(json.at("ssim").get<double>(), (2.0 * 100 * 110 + 6.5025) / (100.0 * 100 + 110.0 * 110 + 6.5025), 1e-5);
  EXPECT_GT(json.at("flip").get<double>(), 0.03);
  EXPECT_EQ(json.at("flip"), Json::parse(flat.out).at("flip"));
  EXPECT_TRUE(holds(run("compare " + path("c.png") + " " + path("d.png")).out, "FLIP                0."));
}

TEST_F(Program, CompareOfIdenticalPicturesIsInf) {
  write_png(path("a.png"), grey(4, 100));
  const Outcome json = run("compare " + path("a.png") + " " + path("a.png") + " --json");
  EXPECT_EQ(json.code, 0);
  EXPECT_EQ(Json::parse(json.out).at("psnr_db"), "inf");
  EXPECT_EQ(Json::parse(json.out).at("flip"), 0.0);
  EXPECT_TRUE(holds(run("compare " + path("a.png") + " " + path("a.png")).out, "inf dB"));
}

TEST_F(Program, CompareOfDifferentSizesNamesBothFiles) {
  write_png(path("a.png"), grey(4, 100));
  write_png(path("b.png"), grey(5, 100));
  const Outcome outcome = run("compare " + path("a.png") + " " + path("b.png"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(holds(outcome.err, path("a.png") + " has 4x2")) << outcome.err;
  EXPECT_TRUE(holds(outcome.err, path("b.png") + " has 5x2")) << outcome.err;
}

TEST_F(Program, SceneWritesWhatInfoReads) {
  const Outcome scene = run("scene city -o " + path("city.las") + " --points 10k --seed 3 --json");
  ASSERT_EQ(scene.code, 0) << scene.err;
  EXPECT_EQ(Json::parse(scene.out).at("points"), 10'000);
  EXPECT_EQ(Json::parse(scene.out).at("bytes"), fs::file_size(path("city.las")));
  const Outcome info = run("info " + path("city.las") + " --json");
  ASSERT_EQ(info.code, 0) << info.err;
  const Json json = Json::parse(info.out);
  EXPECT_EQ(json.at("format"), "LAS");
  EXPECT_EQ(json.at("points"), 10'000);
  EXPECT_GT(json.at("bytes_per_point").get<double>(), 12.0);
  EXPECT_EQ(json.at("grid").at("scale").size(), 3u);
  EXPECT_TRUE(json.at("stated_bounds").at("min").at(2).is_number());
  EXPECT_EQ(json.at("attributes").at(0).size(), 5u);
  EXPECT_TRUE(json.at("warnings").is_array());
  EXPECT_TRUE(holds(run("info " + path("city.las")).out, "points         10,000\n"));
}

}  // namespace
}  // namespace stipple::test::command_program
