// Files that are cut off or damaged at random: an Error or all the points, never a crash.
#include <gtest/gtest.h>

#include <random>

#include "octree/read/las/las_header.h"
#include "octree/read/las/las_source.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::octree_las_robustness {
namespace {

using test::Bytes;
using test::contains;
using test::LasFile;
using test::ScratchFolder;

// One file for each way in which the header differs.
std::vector<LasFile> different_files() {
  const test::Record extra = test::extra_bytes_record({{"a", 3, 24, {0.5}, {1.0}}, {"b", 24}});
  const test::Record other{"somebody", 7, Bytes(21)};
  return {{.minor = 0, .format = 1},
          {.minor = 2, .format = 2, .extra_bytes = 9, .vlrs = {other, extra}},
          {.minor = 3, .format = 5},
          {.minor = 4, .format = 7, .extra_bytes = 8, .vlrs = {other}, .evlrs = {other, extra}},
          {.minor = 5, .format = 10, .extra_bytes = 3}};
}

std::size_t read_all(const LasSource& source) {
  std::vector<std::size_t> everything(source.info().schema.size());
  for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
  std::atomic<std::size_t> points{0};
  source.read(everything, [&](const PointBatch& batch) { points += batch.positions.size(); });
  return points;
}

// What parse_header() promises of any header that it accepts.
void expect_consistent(const las::Header& header, std::size_t file_size) {
  ASSERT_LE(header.points_begin, file_size);
  if (!header.compressed) {
    ASSERT_LE(header.point_count, (file_size - header.points_begin) / header.record_length);
  }
  ASSERT_GE(header.record_length, las::record_size(header.point_format));
  for (const las::Field& field : header.fields) ASSERT_LE(field.offset + field.attribute.bytes(), header.record_length);
  for (int axis = 0; axis < 3; ++axis) ASSERT_GT(header.grid.scale[axis], 0.0);
}

TEST(LasRobustness, AFileCutOffAtAnyByteIsAnErrorOrHasAllItsPoints) {
  const ScratchFolder folder;
  for (const LasFile& file : different_files()) {
    const std::string path = folder.write("cut.las", file.bytes());
    for (std::size_t size = file.bytes().size() + 1; size-- > 0;) {
      std::filesystem::resize_file(path, size);
      try {
        const LasSource source(path);
        ASSERT_GE(size, file.points_end());
        ASSERT_EQ(read_all(source), file.points);
      } catch (const Error& error) {
        ASSERT_LT(size, file.points_end());
        ASSERT_TRUE(contains(error.what(), path + ": at byte "));
      }
    }
  }
}

// Overwrites one to four places, more often than not in the header, with random or telling values.
void damage(Bytes& bytes, std::mt19937& random) {
  constexpr std::uint8_t kTelling[] = {0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
  const std::size_t places = 1 + random() % 4;
  for (std::size_t p = 0; p < places; ++p) {
    const std::size_t reach = random() % 4 != 0 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
    const std::size_t begin = random() % reach;
    const std::size_t length = std::min<std::size_t>(std::size_t{1} << random() % 4, bytes.size() - begin);
    const bool telling = random() % 2 == 0;
    const std::uint8_t value = kTelling[random() % std::size(kTelling)];
    for (std::size_t b = 0; b < length; ++b)
      bytes[begin + b] = static_cast<std::byte>(telling ? value : static_cast<std::uint8_t>(random()));
  }
}

TEST(LasRobustness, ADamagedHeaderIsAnErrorOrConsistent) {
  std::mt19937 random(20'251'122);
  int accepted = 0, refused = 0;
  for (const LasFile& file : different_files()) {
    const Bytes whole = file.bytes();
    for (int i = 0; i < 20'000; ++i) {
      Bytes bytes = whole;
      damage(bytes, random);
      if (random() % 8 == 0) bytes.resize(random() % bytes.size());
      try {
        expect_consistent(las::parse_header(bytes, "damaged.las"), bytes.size());
        ++accepted;
      } catch (const Error& error) {
        ASSERT_TRUE(contains(error.what(), "damaged.las: at byte "));
        ++refused;
      }
    }
  }
  // The damage is neither so heavy nor so light that only one way through the parser is taken
  EXPECT_GT(accepted, 10'000);
  EXPECT_GT(refused, 10'000);
}

TEST(LasRobustness, ADamagedFileIsAnErrorOrReadWhole) {
  const ScratchFolder folder;
  std::mt19937 random(4'711);
  for (const LasFile& file : different_files()) {
    const Bytes whole = file.bytes();
    for (int i = 0; i < 400; ++i) {
      Bytes bytes = whole;
      damage(bytes, random);
      const std::string path = folder.write("damaged.las", bytes);
      try {
        const LasSource source(path);
        ASSERT_EQ(read_all(source), source.info().point_count);
      } catch (const Error& error) {
        ASSERT_TRUE(contains(error.what(), path + ": at byte "));
      }
    }
  }
}

}  // namespace
}  // namespace stipple::test::octree_las_robustness
