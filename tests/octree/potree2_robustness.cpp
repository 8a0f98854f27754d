// Any bytes at all are an error or a tree: no crash, no hang, no memory out of proportion.
#include "tests/octree/potree2_files.h"
#include "tests/octree/tree_damage.h"

namespace stipple::test::octree_potree2_robustness {
namespace {

using test::Bytes;
using test::damage;
using test::peak_bytes;
using test::ScratchFolder;
using test::survives;
using test::TreeFiles;

constexpr const char* kNames[] = {"metadata.json", "hierarchy.bin", "octree.bin"};

std::vector<Bytes> contents_of(const TreeFiles& files) {
  return {TreeFiles::bytes_of(files.metadata()), files.hierarchy(), files.octree()};
}

class Potree2Robustness : public testing::TestWithParam<const char*> {};

TEST_P(Potree2Robustness, DamagedFilesAreAnErrorOrReadWhole) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual(GetParam());
  files.write(folder);
  const std::vector<Bytes> contents = contents_of(files);
  std::mt19937 random(20'251'122);
  const std::uint64_t peak_before = peak_bytes();
  int whole = 0, refused = 0;
  for (std::size_t f = 0; f < contents.size(); ++f) {
    for (int i = 0; i < 1'500; ++i) {
      Bytes bytes = contents[f];
      damage(bytes, random);
      folder.write(kNames[f], bytes);
      ++(survives(folder.path("")) ? whole : refused);
    }
    folder.write(kNames[f], contents[f]);
  }
  // The damage is neither so heavy nor so light that only one way through the reader is taken
  EXPECT_GT(whole, 60);
  EXPECT_GT(refused, 1'500);
  EXPECT_LT(peak_bytes() - peak_before, std::uint64_t{1} << 30);
}

TEST_P(Potree2Robustness, AFileCutOffAnywhereIsAnError) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual(GetParam());
  files.write(folder);
  const std::vector<Bytes> contents = contents_of(files);
  for (std::size_t f = 0; f < contents.size(); ++f) {
    const std::size_t last = contents[f].size() - 1;
    for (std::size_t place = 0; place < 200; ++place) {
      Bytes bytes = contents[f];
      bytes.resize(place * last / 199);
      folder.write(kNames[f], bytes);
      ASSERT_FALSE(survives(folder.path(""))) << kNames[f] << " of " << bytes.size() << " bytes";
    }
    folder.write(kNames[f], contents[f]);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Potree2Robustness, testing::Values("DEFAULT", "BROTLI"));

}  // namespace
}  // namespace stipple::test::octree_potree2_robustness
