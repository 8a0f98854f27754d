// Any bytes at all are an error or a tree: no crash, no hang, no memory out of proportion.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <random>

#include "src/check/check_tree.h"
#include "tests/octree/potree2_files.h"

namespace stipple {
namespace {

using test::Bytes;
using test::contains;
using test::ScratchFolder;
using test::TreeFiles;

constexpr const char* kNames[] = {"metadata.json", "hierarchy.bin", "octree.bin"};

std::vector<Bytes> contents_of(const TreeFiles& files) {
  return {TreeFiles::bytes_of(files.metadata()), files.hierarchy(), files.octree()};
}

// Opens, reads and checks it all. Whether that went without an error.
bool survives(const std::string& path) {
  bool whole = true;
  try {
    check_tree(*open_tree(path));
    const auto source = open_source(path);
    std::vector<std::size_t> everything(source->info().schema.size());
    for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
    std::atomic<std::uint64_t> points{0};
    source->read(everything, [&](const PointBatch& batch) { points += batch.positions.size(); });
    EXPECT_EQ(points, source->info().point_count);
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), path));
    whole = false;
  }
  return whole;
}

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Overwrites one to four places with random or telling values; sometimes cuts the rest off.
void damage(Bytes& bytes, std::mt19937& random) {
  constexpr std::uint8_t kTelling[] = {0x00, 0x01, 0x02, 0x7F, 0x80, 0xFF, '9', '"', '-', '}'};
  const std::size_t places = 1 + random() % 4;
  for (std::size_t p = 0; p < places; ++p) {
    const std::size_t begin = random() % bytes.size();
    const std::size_t length = std::min<std::size_t>(std::size_t{1} << random() % 4, bytes.size() - begin);
    const bool telling = random() % 2 == 0;
    const std::uint8_t value = kTelling[random() % std::size(kTelling)];
    for (std::size_t b = 0; b < length; ++b)
      bytes[begin + b] = static_cast<std::byte>(telling ? value : static_cast<std::uint8_t>(random()));
  }
  if (random() % 16 == 0) bytes.resize(random() % bytes.size());
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
    for (int i = 0; i < 5'000; ++i) {
      Bytes bytes = contents[f];
      damage(bytes, random);
      folder.write(kNames[f], bytes);
      ++(survives(folder.path("")) ? whole : refused);
    }
    folder.write(kNames[f], contents[f]);
  }
  // The damage is neither so heavy nor so light that only one way through the reader is taken
  EXPECT_GT(whole, 200);
  EXPECT_GT(refused, 5'000);
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
}  // namespace stipple
