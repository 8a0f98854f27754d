// Any bytes at all in a tree with a file for every node are an error or a tree: no crash, no hang, no memory out of
// proportion.
#include "tests/octree/node_files.h"
#include "tests/octree/tree_damage.h"

namespace stipple::test::octree_node_files_robustness {
namespace {

using test::Bytes;
using test::damage;
using test::EptFiles;
using test::peak_bytes;
using test::Potree1Files;
using test::ScratchFolder;
using test::survives;

// Damages each of these files many times over.
void expect_no_harm(const ScratchFolder& folder, const std::vector<std::string>& files) {
  std::mt19937 random(20'261'122);
  const std::uint64_t peak_before = peak_bytes();
  int whole = 0, refused = 0;
  for (const std::string& file : files) {
    const Bytes original = test::read_bytes(folder.path(file));
    for (int i = 0; i < 1'500; ++i) {
      Bytes bytes = original;
      damage(bytes, random);
      test::write_bytes(folder.path(file), bytes);
      ++(survives(folder.path("")) ? whole : refused);
    }
    for (std::size_t place = 0; place < 50; ++place) {
      Bytes bytes = original;
      bytes.resize(place * (original.size() - 1) / 49);
      test::write_bytes(folder.path(file), bytes);
      survives(folder.path(""));
    }
    test::write_bytes(folder.path(file), original);
    EXPECT_TRUE(survives(folder.path("")));
  }
  // The damage is neither so heavy nor so light that only one way through the reader is taken
  EXPECT_GT(whole, 50);
  EXPECT_GT(refused, 500);
  EXPECT_LT(peak_bytes() - peak_before, std::uint64_t{1} << 30);
}

TEST(NodeFilesRobustness, DamagedEptIsAnErrorOrReadsWhole) {
  for (const std::string type : {"binary", "zstandard"}) {
    const ScratchFolder folder;
    EptFiles files;
    files.data_type = type;
    files.write(folder);
    expect_no_harm(folder, {"ept.json", "ept-hierarchy/0-0-0-0.json", "ept-hierarchy/1-0-0-0.json",
                            EptFiles::node_file("r", type)});
  }
}

TEST(NodeFilesRobustness, DamagedPotree1IsAnErrorOrReadsWhole) {
  for (const std::string version : {"1.4", "1.7", "1.8"}) {
    const ScratchFolder folder;
    Potree1Files files;
    files.version = version;
    files.write(folder);
    std::vector<std::string> names{"cloud.js", files.file_of("r", ".bin")};
    if (!files.is_flat()) names.insert(names.end(), {"data/r/r.hrc", "data/r/0/r0.hrc"});
    expect_no_harm(folder, names);
  }
}

}  // namespace
}  // namespace stipple::test::octree_node_files_robustness
