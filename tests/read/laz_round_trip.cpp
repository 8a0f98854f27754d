// What a plain encoder wrote, decoded: points of all kinds, without any file of others.
#include <random>

#include "octree/read/laz/laz_source.h"
#include "tests/read/laz_writer.h"

namespace stipple::test::read_laz_round_trip {
namespace {

// How the values of a record follow one another.
enum class Kind { random, smooth, constant };

Bytes make_records(const LasFile& las, Kind kind, unsigned channels) {
  std::mt19937 random(static_cast<unsigned>(las.format) + 1);
  const std::size_t length = las.record_length();
  Bytes records(las.points * length);
  std::int32_t x = 0;
  std::uint64_t time = std::uint64_t{1} << 60;
  for (std::size_t i = 0; i < las.points; ++i) {
    std::byte* const record = records.data() + i * length;
    if (kind == Kind::random)
      for (std::size_t b = 0; b < length; ++b) record[b] = static_cast<std::byte>(random());
    if (kind == Kind::smooth) {
      x += static_cast<std::int32_t>(random() % 60) - 20;
      const std::int32_t y = x / 2 - static_cast<std::int32_t>(random() % 9), z = 1000 + x % 77;
      std::memcpy(record, &x, 4);
      std::memcpy(record + 4, &y, 4);
      std::memcpy(record + 8, &z, 4);
      for (std::size_t b = 12; b < length; ++b)
        record[b] = static_cast<std::byte>(random() % 8 == 0 ? random() % 5 : 1);
      // Four pulses at a time, steps that repeat, and jumps
      if (i % 3 == 0) time += random() % 40 == 0 ? std::uint64_t{1} << 40 : 1000 * (1 + random() % 12) + random() % 3;
      const std::uint64_t own = time + (random() % 2 << 36);
      const std::size_t at = las.format < 6 ? 20 : 22;
      if (las.format == 1 || las.format >= 3) std::memcpy(record + at, &own, 8);
    }
    if (las.format >= 6)
      record[15] = static_cast<std::byte>((std::to_integer<unsigned>(record[15]) & 0xCFu) | random() % channels << 4);
  }
  return records;
}

void expect_round_trip(int format, Kind kind, unsigned channels, int version, const std::vector<std::size_t>& chunks,
                       bool variable) {
  LasFile las;
  las.minor = format < 6 ? 2 : 4;
  las.format = format;
  las.extra_bytes = 3;
  las.points = std::accumulate(chunks.begin(), chunks.end(), std::size_t{0});
  las.vlrs = {extra_bytes_record({{"a", 1}, {"b", 3}})};
  const Bytes records = make_records(las, kind, channels);
  const ScratchFolder folder;
  Bytes plain = las.bytes();
  std::ranges::copy(records, plain.begin() + static_cast<std::ptrdiff_t>(las.points_begin()));
  const auto laz = open_file(folder.write("cloud.laz", LazWriter(las, records, version).write(chunks, variable)));
  EXPECT_EQ(laz->info().format, "LAZ");
  EXPECT_EQ(laz->info().warnings, Strings{});
  expect_equal(load_all(*laz), load_all(*open_file(folder.write("cloud.las", plain))));
}

class LazRoundTrip : public testing::TestWithParam<std::tuple<int, Kind>> {
 protected:
  void expect_kept(const std::vector<std::size_t>& chunks, bool variable) const {
    const auto [format, kind] = GetParam();
    expect_round_trip(format, kind, 1, format < 6 ? 2 : 3, chunks, variable);
  }
};

TEST_P(LazRoundTrip, ChunksOfOneSizeKeepEveryValue) {
  expect_kept({5'000, 5'000, 1'234}, false);
}

TEST_P(LazRoundTrip, ChunksOfAnySizeKeepEveryValue) {
  expect_kept({1, 2, 3'000, 7, 700}, true);
}

INSTANTIATE_TEST_SUITE_P(All, LazRoundTrip,
                         testing::Combine(testing::Values(0, 1, 2, 3, 6, 7),
                                          testing::Values(Kind::random, Kind::smooth, Kind::constant)));

TEST(LazRoundTripOfChannels, PointsOfFourScannersKeepEveryValue) {
  for (const int format : {6, 7})
    for (const Kind kind : {Kind::random, Kind::smooth, Kind::constant})
      expect_round_trip(format, kind, 4, 4, {2'000, 2'000}, false);
}

}  // namespace
}  // namespace stipple::test::read_laz_round_trip
