// Any bytes at all in a tree with a file for every node are an error or a tree: no crash, no hang, no memory out of
// proportion.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <random>

#include "src/check/check_tree.h"
#include "tests/octree/node_files.h"

namespace stipple {
namespace {

using test::Bytes;
using test::contains;
using test::EptFiles;
using test::Potree1Files;
using test::ScratchFolder;

// Opens, reads and checks it all. Whether that went without an error.
bool survives(const std::string& path) {
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
    return false;
  }
  return true;
}

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Overwrites one to four places with random or telling values; sometimes cuts the rest off.
void damage(Bytes& bytes, std::mt19937& random) {
  constexpr std::uint8_t kTelling[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, '9', '"', '-', '}', ']'};
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
}  // namespace stipple
