// `stipple build` as a user meets it: limits on memory, kills, interruptions, output.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <thread>

#include "tests/command/run_stipple.h"

namespace stipple::test::command_build {
namespace {

namespace fs = std::filesystem;

class BuildCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  Outcome run(const std::string& arguments) const { return run_stipple(folder_, arguments); }

  // The result, the last line of --json.
  static Json result_of(const Outcome& outcome) {
    const std::string text = outcome.out.substr(0, outcome.out.size() - 1);
    return Json::parse(text.substr(text.rfind('\n') + 1));
  }

  // Starts a build, and sends it a signal after a while: of milliseconds, or until it has begun to write. Returns its
  // wait status.
  int build_and_signal(const std::string& input, const std::string& output, int signal,
                       std::optional<int> milliseconds) const {
    const pid_t child = ::fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      ::execl(STIPPLE_PROGRAM, STIPPLE_PROGRAM, "build", input.c_str(), "-o", output.c_str(), "--memory", "128M",
              "--force", "--json", nullptr);
      ::_exit(127);
    }
    if (milliseconds) {
      std::this_thread::sleep_for(std::chrono::milliseconds(*milliseconds));
    } else {
      for (int waited = 0; waited < 10'000 && leftovers().empty(); ++waited)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }

  std::vector<std::string> leftovers() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(path("")))
      if (entry.path().filename().string().starts_with(".tree")) names.push_back(entry.path().filename().string());
    return names;
  }

  ScratchFolder folder_;
};

TEST_F(BuildCommand, BuildsWhatCheckFindsWhole) {
  const std::string city = city_file(folder_, 100'000);
  const Outcome build = run("build " + city + " -o " + path("tree") + " --json");
  ASSERT_EQ(build.code, 0) << build.err;
  const Json result = result_of(build);
  EXPECT_EQ(result.at("points"), 100'000);
  EXPECT_EQ(result.at("largest_rounding"), 0.0);
  EXPECT_EQ(run("check " + path("tree") + " --against " + city).code, 0);
}

TEST_F(BuildCommand, TakesFoldersOfFiles) {
  fs::create_directories(path("tiles"));
  city_file(folder_, 20'000, "tiles/a.las");
  city_file(folder_, 30'000, "tiles/b.LAS");
  std::ofstream(path("tiles/readme.txt")) << "no cloud";
  const Outcome build = run("build " + path("tiles") + " -o " + path("tree") + " --json --sampling random");
  ASSERT_EQ(build.code, 0) << build.err;
  EXPECT_EQ(result_of(build).at("points"), 50'000);
  fs::create_directories(path("empty"));
  EXPECT_EQ(run("build " + path("empty") + " -o " + path("none")).code, 1);
}

TEST_F(BuildCommand, WrongUsageIsTwoAndFailedWorkOne) {
  const std::string city = city_file(folder_, 1'000);
  EXPECT_EQ(run("build " + city + " -o " + path("tree") + " --memory little").code, 2);
  EXPECT_EQ(run("build " + city + " -o " + path("tree") + " --memory 1M").code, 2);
  EXPECT_EQ(run("build " + city + " -o " + path("tree") + " --sampling best").code, 2);
  EXPECT_EQ(run("build " + city).code, 2);
  EXPECT_EQ(run("build " + city + " -o " + path("tree")).code, 0);
  const Outcome again = run("build " + city + " -o " + path("tree"));
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
  EXPECT_EQ(run("build " + city + " -o " + path("tree") + " --force").code, 0);
}

TEST_F(BuildCommand, StaysWithinItsMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own memory would count as the builder's";
#endif
  const std::string city = city_file(folder_, 3'000'000);
  const Outcome bounded = run("build " + city + " -o " + path("tree") + " --memory 128M --json");
  ASSERT_EQ(bounded.code, 0) << bounded.err;
  const Json result = result_of(bounded);
  EXPECT_GT(result.at("bytes_spilled").get<std::uint64_t>(), 50'000'000u);
  EXPECT_LE(result.at("peak_memory_bytes").get<std::uint64_t>(), 128u << 20);
  ASSERT_EQ(run("build " + city + " -o " + path("free") + " --json").code, 0);
  for (const char* name : {"hierarchy.bin", "octree.bin", "stipple.bin"})
    EXPECT_TRUE(text_of(path("tree/") + name) == text_of(path("free/") + name)) << name;
}

// Once a cloud spills, what is in memory is a part of it, of a size that does not depend on how many there are.
TEST_F(BuildCommand, ThreeTimesThePointsTakeNoMoreMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own memory would count as the builder's";
#endif
  const auto peak = [&](std::uint64_t points) {
    const Outcome built =
        run("build " + city_file(folder_, points) + " -o " + path("tree") + " --force --memory 128M --json");
    EXPECT_EQ(built.code, 0) << built.err;
    EXPECT_GT(result_of(built).at("bytes_spilled").get<std::uint64_t>(), 0u);
    return result_of(built).at("peak_memory_bytes").get<double>();
  };
  const double small = peak(2'000'000);
  EXPECT_LE(peak(6'000'000), 1.2 * small);
}

TEST_F(BuildCommand, SurvivesKillsAtRandomMoments) {
  const std::string city = city_file(folder_, 600'000);
  ASSERT_EQ(run("build " + city + " -o " + path("tree")).code, 0);
  const std::string whole = text_of(path("tree/octree.bin"));
  std::mt19937 random(std::random_device{}());
  for (int round = 0; round < 6; ++round) {
    build_and_signal(city, path("tree"), SIGKILL, std::uniform_int_distribution<int>(1, 400)(random));
    EXPECT_TRUE(text_of(path("tree/octree.bin")) == whole);
    EXPECT_EQ(run("check " + path("tree")).code, 0);
  }
  ASSERT_EQ(run("build " + city + " -o " + path("tree") + " --force").code, 0);
  EXPECT_TRUE(text_of(path("tree/octree.bin")) == whole);
  EXPECT_TRUE(leftovers().empty());
}

// A disk of its own, mounted for the test: takes root.
class SmallDisk {
 public:
  SmallDisk(std::string path, const char* size) : path_(std::move(path)) {
    fs::create_directories(path_);
    mounted_ = ::mount("tmpfs", path_.c_str(), "tmpfs", 0, size) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(path_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::string path_;
  bool mounted_ = false;
};

TEST_F(BuildCommand, AKdTreeIsReadByAllThatReadTrees) {
  const std::string city = city_file(folder_, 150'000);
  const Outcome built = run("build " + city + " -o " + path("kd") + " --partition kd --json");
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(result_of(built).at("partition"), "kd");
  ASSERT_EQ(run("build " + city + " -o " + path("octree")).code, 0);
  EXPECT_EQ(run("check " + path("kd") + " --against " + city).code, 0);
  const auto volume = [&](const std::string& tree) {
    const Json info = Json::parse(run("info --exact --json " + path(tree)).out);
    return info.at("octree").at("bounding_volume").get<double>();
  };
  EXPECT_GT(volume("kd"), 0.0);
  EXPECT_GT(volume("octree"), 0.0);

  const std::string draw = "render " + path("kd") + " --size 160x90 -o " + path("out.png") + " --mode ";
  std::string expected;
  for (const std::string mode : {"brute-force", "hierarchical", "unstructured", "hybrid", "lod"}) {
    const Outcome drawn = run(draw + mode + " --budget 200k --position-out " + path("p.npy"));
    ASSERT_EQ(drawn.code, 0) << mode << drawn.err;
    std::ifstream file(path("p.npy"), std::ios::binary);
    const std::string positions{std::istreambuf_iterator<char>(file), {}};
    if (expected.empty()) expected = positions;
    EXPECT_TRUE(positions == expected) << mode;
  }

  for (const char* options :
       {"--partition round", "--partition kd --sampling random", "--partition kd --encoding BROTLI"})
    EXPECT_EQ(run("build " + city + " -o " + path("x") + " " + options).code, 2) << options;
}

TEST_F(BuildCommand, AFullDiskLeavesTheOldTree) {
  const SmallDisk disk(path("disk"), "size=16M");
  if (!disk.mounted()) GTEST_SKIP() << "may not mount a disk here";
  const std::string small = city_file(folder_, 100'000, "small.las");
  const std::string large = city_file(folder_, 2'000'000, "large.las");
  ASSERT_EQ(run("build " + small + " -o " + path("disk/tree")).code, 0);
  for (const char* options : {" --force", " --force --memory 256M"}) {
    const Outcome full = run("build " + large + " -o " + path("disk/tree") + options);
    EXPECT_EQ(full.code, 1);
    EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
    EXPECT_EQ(run("check " + path("disk/tree") + " --against " + small).code, 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(path("disk")), fs::directory_iterator()), 1);
  }
  EXPECT_EQ(run("build " + small + " -o " + path("disk/tree") + " --force").code, 0);
}

TEST_F(BuildCommand, AnInterruptionLeavesNothing) {
  const std::string city = city_file(folder_, 1'000'000);
  for (const int signal : {SIGINT, SIGTERM}) {
    const int status = build_and_signal(city, path("tree"), signal, std::nullopt);
    ASSERT_TRUE(WIFEXITED(status)) << "the signal was not caught";
    EXPECT_TRUE(leftovers().empty());
    EXPECT_EQ(WEXITSTATUS(status) == 0, fs::exists(path("tree")));
  }
}

}  // namespace
}  // namespace stipple::test::command_build
