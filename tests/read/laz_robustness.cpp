// LAZ files that are cut off or damaged: an Error that names the place, or all the points, never a crash.
#include <random>

#include "octree/read/laz/laz_source.h"
#include "tests/read/laz_fixture.h"

namespace stipple::test::read_laz_robustness {
namespace {

using test::Bytes;
using test::contains;
using test::count_points;
using test::error_of;
using test::get;
using test::laz_file;
using test::put;
using test::ScratchFolder;

class LazRobustness : public testing::TestWithParam<const char*> {
 protected:
  Bytes whole_ = test::bytes_of(laz_file(GetParam()));
  ScratchFolder folder_;
};

TEST_P(LazRobustness, AFileCutOffAnywhereIsAnErrorOrHasAllItsPoints) {
  SKIP_WITHOUT_LAZ_FILES();
  const std::uint64_t points = open_file(laz_file(GetParam()).string())->info().point_count;
  const std::string path = folder_.write("cut.laz", whole_);
  const std::size_t step = std::max<std::size_t>(1, whole_.size() / 200);
  std::size_t errors = 0;
  for (std::size_t size = whole_.size(); size > step; size -= step) {
    std::filesystem::resize_file(path, size);
    try {
      const auto source = open_file(path);
      EXPECT_EQ(count_points(*source), points);
      EXPECT_TRUE(size == whole_.size() || !source->info().warnings.empty()) << size;
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), path + ": at byte "));
      ++errors;
    }
  }
  EXPECT_GT(errors, 100u);
}

TEST_P(LazRobustness, ADamagedFileIsAnErrorOrReadWhole) {
  SKIP_WITHOUT_LAZ_FILES();
  std::mt19937 random(1'815);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    Bytes bytes = whole_;
    for (std::size_t places = 1 + random() % 4; places > 0; --places) {
      // Half of the damage goes to the header and what describes the compression
      const std::size_t reach = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 700) : bytes.size();
      bytes[random() % reach] = static_cast<std::byte>(random());
    }
    if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
    const std::string path = folder_.write("damaged.laz", bytes);
    try {
      const auto source = open_file(path);
      ASSERT_EQ(count_points(*source), source->info().point_count);
    } catch (const Error& error) {
      ASSERT_TRUE(contains(error.what(), path + ": at byte "));
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

INSTANTIATE_TEST_SUITE_P(Files, LazRobustness,
                         testing::Values("point-time-color.laz", "pdrf5-1.3.laz", "pdrf8-1.4.laz", "pdrf10-1.5.laz",
                                         "autzen.copc.laz"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return c == '-' || c == '.'; });
                           return name;
                         });

TEST(LazErrors, AChunkThatEndsTooEarlyNamesChunkPointAndByte) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes bytes = test::bytes_of(laz_file("point-time-color.laz"));
  // Without its table, the only chunk ends where the file does
  const auto points = get<std::uint32_t>(bytes, 96);
  put(bytes, points, static_cast<std::int64_t>(points));
  bytes.resize(bytes.size() / 2);
  const auto source = open_file(folder.write("a.laz", bytes));
  EXPECT_TRUE(contains(error_of([&] { count_points(*source); }),
                       "at byte " + std::to_string(bytes.size()) + ": chunk 0, of 1065 points from byte " +
                           std::to_string(points + 8) + " on, ends in its point "));
}

TEST(LazErrors, ALayerThatEndsTooEarlyIsNamed) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes bytes = test::bytes_of(laz_file("pdrf8-1.4.laz"));
  const std::size_t sizes = get<std::uint32_t>(bytes, 96) + 8 + 42 + 4;
  // What the first layer loses, the second wins, so that all others stay where they are
  put(bytes, sizes + 4, get<std::uint32_t>(bytes, sizes + 4) + get<std::uint32_t>(bytes, sizes) - 40);
  put(bytes, sizes, std::uint32_t{40});
  const auto source = open_file(folder.write("a.laz", bytes));
  EXPECT_TRUE(contains(error_of([&] { count_points(*source); }), "ends its layer \"x, y and returns\" in point "));
}

TEST(LazErrors, AChunkThatContradictsTheTableIsNamed) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes bytes = test::bytes_of(laz_file("pdrf8-1.4.laz"));
  const std::size_t count = get<std::uint32_t>(bytes, 96) + 8 + 42;
  put(bytes, count, std::uint32_t{255});
  const auto source = open_file(folder.write("a.laz", bytes));
  EXPECT_TRUE(contains(error_of([&] { count_points(*source); }), "states 255 points itself"));
}

TEST(LazErrors, MorePointsThanTheFileCanHoldAreAnErrorBeforeTheyAreMadeRoomFor) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes bytes = test::bytes_of(laz_file("point-time-color.laz"));
  put(bytes, 107, std::uint32_t{4'000'000'000});
  EXPECT_TRUE(contains(error_of([&] { open_file(folder.write("a.laz", bytes)); }), ": at byte "));
}

TEST(LazErrors, ACompressedFileWithoutTheRecordThatSaysHow) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes bytes = test::bytes_of(laz_file("point10-1.0.las"));
  put(bytes, 104, std::uint8_t{0x80});
  EXPECT_TRUE(contains(error_of([&] { open_file(folder.write("a.laz", bytes)); }),
                       "at byte 104: the points are LAZ-compressed"));
}

}  // namespace
}  // namespace stipple::test::read_laz_robustness
