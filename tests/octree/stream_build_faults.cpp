// What is left when a build does not succeed, and what it may replace.
#include <fcntl.h>
#include <sys/resource.h>

#include <csignal>

#include "octree/read/las/las_writer.h"
#include "octree/read/open.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::octree_stream_build_faults {
namespace {

const TestCloud& cloud() {
  static const TestCloud cloud{"terrain", terrain(30'000, 5)};
  return cloud;
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(StreamBuild, LeavesNothingWhenASourceFails) {
  Sources sources = sources_of(cloud());
  static_cast<CloudSource&>(*sources.front()).fail_after = 15'000;
  for (const std::uint64_t most : {std::uint64_t{5'000}, std::numeric_limits<std::uint64_t>::max()}) {
    StreamOptions options = small_nodes();
    options.most_in_memory = most;
    EXPECT_THROW(build(sources, "tree", options), Error);
    EXPECT_EQ(entries(), 0u);
  }
}

// Reads a LAS file that loses its end once its points have been counted.
class CutSource : public PointSource {
 public:
  explicit CutSource(const std::string& path) : path_(path), file_(open_file(path)) {}
  const SourceInfo& info() const override { return file_->info(); }
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override {
    if (!attributes.empty()) fs::resize_file(path_, fs::file_size(path_) / 2);
    file_->read(attributes, consume);
  }

 private:
  std::string path_;
  std::unique_ptr<PointSource> file_;
};

TEST_F(StreamBuild, NamesAFileThatIsCutOffWhileItIsRead) {
  fs::create_directories(path("input"));
  const std::string file = path("input/cloud.las");
  write_las(CloudSource(cloud()), file);
  Sources sources;
  sources.push_back(std::make_unique<CutSource>(file));
  const std::string message = message_of([&] { build(sources, "tree", small_nodes()); });
  EXPECT_NE(message.find(file), std::string::npos) << message;
  EXPECT_EQ(entries(), 1u);
}

TEST_F(StreamBuild, LeavesTheOldTreeWhenItFails) {
  StreamOptions options = small_nodes();
  build(sources_of(cloud()), "tree", options);
  const std::string before = file_content(path("tree/octree.bin"));
  Sources sources = sources_of(cloud());
  static_cast<CloudSource&>(*sources.front()).fail_after = 15'000;
  options.replace = true;
  EXPECT_THROW(build(sources, "tree", options), Error);
  EXPECT_TRUE(file_content(path("tree/octree.bin")) == before);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(StreamBuild, ReplacesATreeOnlyWhenAskedTo) {
  StreamOptions options = small_nodes();
  build(sources_of(cloud()), "tree", options);
  const Sources other = sources_of({"one", {{7, -8, 9}}});
  EXPECT_NE(message_of([&] { build(other, "tree", options); }).find("--force"), std::string::npos);
  EXPECT_EQ(read_tree(path("tree")).info.source.point_count, cloud().positions.size());
  options.replace = true;
  build(other, "tree", options);
  EXPECT_EQ(read_tree(path("tree")).info.source.point_count, 1u);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(StreamBuild, NeverReplacesAFolderThatIsNoTree) {
  StreamOptions options = small_nodes();
  options.replace = true;
  fs::create_directories(path("photos"));
  std::ofstream(path("photos/a.jpg")) << "dear to somebody";
  EXPECT_NE(message_of([&] { build(sources_of(cloud()), "photos", options); }).find("no Potree 2.0 tree"),
            std::string::npos);
  build(sources_of(cloud()), "tree", options);
  std::ofstream(path("tree/notes.txt")) << "dear to somebody";
  EXPECT_NE(message_of([&] { build(sources_of(cloud()), "tree", options); }).find("notes.txt"), std::string::npos);
  EXPECT_TRUE(fs::exists(path("photos/a.jpg")));
  EXPECT_TRUE(fs::exists(path("tree/notes.txt")));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(StreamBuild, BuildsIntoAnEmptyFolder) {
  fs::create_directories(path("tree"));
  build(sources_of(cloud()), "tree", small_nodes());
  EXPECT_EQ(read_tree(path("tree")).info.source.point_count, cloud().positions.size());
}

TEST_F(StreamBuild, RemovesWhatAKilledBuildLeft) {
  fs::create_directories(path(".tree.stipple-build-1"));
  std::ofstream(path(".tree.stipple-build-1/octree.bin")) << "half of it";
  fs::create_directories(path(".other.stipple-build-1"));  // not of this tree
  build(sources_of(cloud()), "tree", small_nodes());
  EXPECT_FALSE(fs::exists(path(".tree.stipple-build-1")));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(StreamBuild, NamesATargetThatCannotBeWritten) {
  const std::string message = message_of([&] { build(sources_of(cloud()), "missing/tree", small_nodes()); });
  EXPECT_NE(message.find("missing"), std::string::npos) << message;
  std::ofstream(path("file")) << "no folder";
  EXPECT_NE(message_of([&] { build(sources_of(cloud()), "file", small_nodes()); }).find("no folder"),
            std::string::npos);
  EXPECT_EQ(file_content(path("file")), "no folder");
}

TEST_F(StreamBuild, StopsWhenToldTo) {
  BuildMonitor monitor;
  monitor.stop();
  EXPECT_THROW(build_tree(sources_of(cloud()), path("tree"), small_nodes(), monitor), Error);
  EXPECT_EQ(entries(), 0u);
}

// A limit on the size of files is what a full disk looks like to a program, and needs no disk.
TEST_F(StreamBuild, ReportsAFullDiskAndLeavesNothing) {
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit limit { 300'000, before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::string whole, spilled;
  StreamOptions options = small_nodes();
  whole = message_of([&] { build(sources_of(cloud()), "tree", options); });
  options.most_in_memory = 5'000;
  spilled = message_of([&] { build(sources_of(cloud()), "tree", options); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(whole.find("File too large"), std::string::npos) << whole;
  EXPECT_NE(spilled.find("File too large"), std::string::npos) << spilled;
  EXPECT_EQ(entries(), 0u);
}

TEST_F(StreamBuild, RefusesTooLittleMemory) {
  StreamOptions options;
  options.memory = 1 << 20;
  EXPECT_NE(message_of([&] { build(sources_of(cloud()), "tree", options); }).find("128 MiB"), std::string::npos);
}

// Brotli packs a node as a whole: a pile larger than memory cannot be.
TEST_F(StreamBuild, SaysThatAPileIsTooLargeToBePacked) {
  TestCloud pile = test_clouds().front();
  pile.positions.assign(20'000, glm::ivec3(7));
  StreamOptions options = small_nodes();
  options.most_in_memory = 5'000;
  build(sources_of(pile), "plain", options);
  options.encoding = potree2::Encoding::brotli;
  try {
    build(sources_of(pile), "packed", options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--encoding DEFAULT"), std::string::npos) << error.what();
  }
  EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace stipple::test::octree_stream_build_faults
