// What a plain encoder wrote, decoded: points of all kinds, without any file of others.
#include "octree/read/laz/laz_source.h"
#include "tests/read/laz_fixture.h"
#include "tests/read/laz_records.h"
#include "tests/read/laz_writer.h"

namespace stipple::test::read_laz_round_trip {
namespace {

// Records of a point format, as a LAS and as LAZ files.
class TwinFiles {
 public:
  TwinFiles(int format, Kind kind, std::size_t points, unsigned channels = 1, unsigned first_channel = 0)
      : las_(las_for_laz(format, points)), records_(RecordMaker(las_, kind, channels, first_channel).make()) {
    Bytes plain = las_.bytes();
    std::ranges::copy(records_, plain.begin() + static_cast<std::ptrdiff_t>(las_.points_begin()));
    plain_ = load_all(*open_file(folder_.write("cloud.las", plain)));
  }

  const Cloud& plain() const { return plain_; }
  std::unique_ptr<PointSource> compressed(const LazLayout& layout) const {
    auto source = open_file(folder_.write("cloud.laz", LazWriter(las_, records_, layout).write()));
    EXPECT_EQ(source->info().format, "LAZ");
    return source;
  }
  void expect_kept(const LazLayout& layout) const {
    const auto source = compressed(layout);
    EXPECT_EQ(source->info().warnings, Strings{});
    expect_equal(load_all(*source), plain_);
  }

 private:
  LasFile las_;
  Bytes records_;
  ScratchFolder folder_;
  Cloud plain_;
};

constexpr Kind kKinds[] = {Kind::random, Kind::smooth, Kind::constant};

int usual_version(int format) {
  return format < 6 ? 2 : 3;
}

class LazRoundTrip : public testing::TestWithParam<int> {
 protected:
  void expect_kept(const LazLayout& layout) const {
    for (const Kind kind : kKinds) {
      SCOPED_TRACE(static_cast<int>(kind));
      TwinFiles(GetParam(), kind, layout.points()).expect_kept(layout);
    }
  }
  int version() const { return usual_version(GetParam()); }
};

TEST_P(LazRoundTrip, ChunksOfOneSizeKeepEveryValue) {
  expect_kept({version(), {1'500, 1'500, 1'500, 734}});
}

TEST_P(LazRoundTrip, ChunksOfAnySizeKeepEveryValue) {
  expect_kept({version(), {1, 2, 3'000, 7, 700}, Chunking::variable});
}

TEST_P(LazRoundTrip, AnAttributeAloneIsTheSame) {
  const LazLayout layout{version(), {700, 700, 100}};
  const TwinFiles files(GetParam(), Kind::smooth, layout.points());
  const auto source = files.compressed(layout);
  EXPECT_EQ(load_cloud(*source, {}).positions, files.plain().positions);
  for (const Column& column : files.plain().columns) {
    const Cloud one = load_cloud(*source, {column.attribute.name});
    EXPECT_EQ(one.positions, files.plain().positions) << column.attribute.name;
    ASSERT_EQ(one.columns.size(), 1u);
    EXPECT_EQ(one.columns[0].bytes, column.bytes) << column.attribute.name;
  }
}

// A writer that cannot go back puts the place of the table at the end.
TEST_P(LazRoundTrip, ATableThatTheEndOfTheFilePointsToIsFound) {
  const LazLayout fixed{version(), {600, 600, 5}, Chunking::fixed, TablePlace::end_of_file};
  TwinFiles(GetParam(), Kind::smooth, fixed.points()).expect_kept(fixed);
  const LazLayout variable{version(), {600, 9, 100}, Chunking::variable, TablePlace::end_of_file};
  TwinFiles(GetParam(), Kind::smooth, variable.points()).expect_kept(variable);
}

TEST_P(LazRoundTrip, PointsWithoutATableAreReadFromFrontToBack) {
  for (const TablePlace place : {TablePlace::cut_off, TablePlace::unknown}) {
    const LazLayout layout{version(), {600, 600, 5}, Chunking::fixed, place};
    const TwinFiles files(GetParam(), Kind::smooth, layout.points());
    const auto source = files.compressed(layout);
    EXPECT_TRUE(one_that_contains(source->info().warnings, "the points are read from front to back"));
    expect_equal(load_all(*source), files.plain());
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LazRoundTrip, testing::Range(0, 11));

// Point formats 0 to 5, as writers up to 2011 made them.
class LazRoundTripOfStreams : public LazRoundTrip {};

TEST_P(LazRoundTripOfStreams, PointsThatAreNotChunkedKeepEveryValue) {
  for (const int items : {1, 2}) expect_kept({items, {2'500}, Chunking::none});
}

TEST_P(LazRoundTripOfStreams, ItemsOfVersion1KeepEveryValue) {
  expect_kept({1, {900, 900, 34}});
}

INSTANTIATE_TEST_SUITE_P(Formats, LazRoundTripOfStreams, testing::Range(0, 6));

// Point formats 6 to 10.
class LazRoundTripOfLayers : public LazRoundTrip {};

TEST_P(LazRoundTripOfLayers, PointsOfFourScannersKeepEveryValue) {
  for (const Kind kind : kKinds)
    for (const int items : {3, 4}) {
      const LazLayout layout{items, {1'000, 1'000}};
      TwinFiles(GetParam(), kind, layout.points(), 4).expect_kept(layout);
    }
}

TEST_P(LazRoundTripOfLayers, PointsOfAnotherScannerThanTheFirstKeepEveryValue) {
  for (const int items : {3, 4}) {
    const LazLayout layout{items, {500, 500}};
    TwinFiles(GetParam(), Kind::smooth, layout.points(), 1, 2).expect_kept(layout);
  }
}

TEST_P(LazRoundTripOfLayers, ColoursAreReadWithoutTheOtherLayers) {
  for (const int items : {3, 4}) {
    const LazLayout layout{items, {1'000, 400}};
    const TwinFiles files(GetParam(), Kind::smooth, layout.points(), 3);
    const Column* const expected = files.plain().find("rgb");
    const Cloud cloud = load_cloud(*files.compressed(layout), {"rgb"});
    EXPECT_EQ(cloud.positions, files.plain().positions);
    ASSERT_EQ(cloud.columns.size(), expected ? 1u : 0u);
    if (expected) {
      EXPECT_EQ(cloud.columns[0].bytes, expected->bytes);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LazRoundTripOfLayers, testing::Range(6, 11));

// Models halve their counts after 2^15 symbols.
TEST(LazRoundTripOfLongChunks, KeepEveryValue) {
  for (const int format : {5, 10}) {
    const LazLayout layout{usual_version(format), {34'000}};
    TwinFiles(format, Kind::smooth, layout.points()).expect_kept(layout);
  }
}

}  // namespace
}  // namespace stipple::test::read_laz_round_trip
