// LAZ files against the LAS files they were made from.
#include "octree/read/laz/laz_source.h"

#include "octree/read/las/las_source.h"
#include "octree/read/laz/chunk_reader.h"
#include "tests/read/laz_fixture.h"

namespace stipple::test::read_laz_source {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::expect_equal;
using test::get;
using test::laz_file;
using test::load_all;
using test::load_laz;
using test::one_that_contains;
using test::put;
using test::ScratchFolder;
using test::Strings;

constexpr std::size_t kOffsetToPoints = 96;

class LazTwins : public testing::TestWithParam<const char*> {};

TEST_P(LazTwins, HaveTheSameSchemaGridAndValues) {
  SKIP_WITHOUT_LAZ_FILES();
  expect_equal(load_laz(GetParam() + std::string(".laz")), load_laz(GetParam() + std::string(".las")));
}

TEST_P(LazTwins, AttributesAreTheSameWhenNothingElseIsAskedFor) {
  SKIP_WITHOUT_LAZ_FILES();
  const Cloud all = load_laz(GetParam() + std::string(".las"));
  const auto source = open_file(laz_file((GetParam() + std::string(".laz"))).string());
  for (const Column& column : all.columns) {
    const Cloud one = load_cloud(*source, {column.attribute.name});
    EXPECT_EQ(one.positions, all.positions) << column.attribute.name;
    ASSERT_EQ(one.columns.size(), 1u);
    EXPECT_EQ(one.columns[0].bytes, column.bytes) << column.attribute.name;
  }
}

TEST_P(LazTwins, AreToldApartByContentNotByName) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  const auto copy = [&](const std::string& from, const std::string& to) {
    return folder.write(to, test::bytes_of(laz_file(from)));
  };
  const std::string name = GetParam();
  EXPECT_EQ(open_file(copy(name + ".laz", "a.las"))->info().format, "LAZ");
  EXPECT_EQ(open_file(copy(name + ".las", "b.laz"))->info().format, "LAS");
}

INSTANTIATE_TEST_SUITE_P(Files, LazTwins,
                         testing::Values("point-time-color", "pdrf5-1.3", "pdrf8-1.4", "pdrf10-1.5", "point10-1.0"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return c == '-' || c == '.'; });
                           return name;
                         });

TEST(LazSource, InfoNamesFormatVersionAndCompression) {
  SKIP_WITHOUT_LAZ_FILES();
  const auto info = open_file(laz_file("pdrf8-1.4.laz").string())->info();
  EXPECT_EQ(info.format, "LAZ");
  EXPECT_EQ(info.version, "1.4");
  EXPECT_EQ(info.encoding, "point format 8, 42 bytes a point unpacked, chunks of 256 points, items of version 3");
  EXPECT_EQ(info.warnings, Strings{});
}

TEST(LazSource, AFileWithoutPointsIsEmpty) {
  SKIP_WITHOUT_LAZ_FILES();
  const Cloud cloud = load_laz("no-points-1.3.laz");
  EXPECT_EQ(cloud.size(), 0u);
  EXPECT_EQ(cloud.info.warnings, Strings{});
}

TEST(LazSource, ChunksOfVariableSizeAreFoundByTheTable) {
  SKIP_WITHOUT_LAZ_FILES();
  const Cloud cloud = load_laz("autzen.copc.laz");
  EXPECT_EQ(cloud.size(), 107u);
  EXPECT_TRUE(contains(cloud.info.encoding, "chunks of variable size"));
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], cloud.info.stated_bounds.min[axis], 0.005);
    EXPECT_NEAR(box.max[axis], cloud.info.stated_bounds.max[axis], 0.005);
  }
}

TEST(LazSource, BatchesAreDisjointAndWhole) {
  SKIP_WITHOUT_LAZ_FILES();
  const LazSource source(laz_file("pdrf5-1.3.laz").string());
  std::vector<std::atomic<int>> seen(source.info().point_count);
  source.read({}, [&](const PointBatch& batch) {
    for (std::size_t i = 0; i < batch.positions.size(); ++i) ++seen.at(batch.first + i);
  });
  for (const auto& times : seen) EXPECT_EQ(times, 1);
}

TEST_P(LazTwins, ChunksDecodedSideBySideAreTheSame) {
  SKIP_WITHOUT_LAZ_FILES();
  const std::string path = laz_file((GetParam() + std::string(".laz"))).string();
  const InputFile file(path);
  const las::Header header = las::parse_header(file.map().bytes(), path);
  const laz::Format format = laz::read_format(file.map().bytes(), header, path);
  Strings warnings;
  const auto chunks = laz::read_chunk_table(file, header, format, warnings).chunks;
  const Cloud expected = load_laz(GetParam() + std::string(".las"));

  // The second of each pair is taken in other pieces than the first
  laz::ChunkReader a(file, format, header.fields), b(file, format, header.fields);
  PointBatch batch_a, batch_b;
  const laz::Chunk& chunk_a = chunks.front();
  const laz::Chunk& chunk_b = chunks.back();
  a.begin(chunk_a);
  b.begin(chunk_b);
  std::size_t done_a = 0, done_b = 0;
  bool odd = false;
  const auto expect_points = [&](const PointBatch& batch, std::size_t first) {
    for (std::size_t i = 0; i < batch.positions.size(); ++i)
      ASSERT_EQ(batch.positions[i], expected.positions[first + i]);
    for (std::size_t c = 0; c < batch.columns.size(); ++c)
      ASSERT_TRUE(std::ranges::equal(batch.columns[c].bytes, std::span(expected.columns[c].bytes)
                                                                 .subspan(first * expected.columns[c].attribute.bytes(),
                                                                          batch.columns[c].bytes.size())));
  };
  while (done_a < chunk_a.points || done_b < chunk_b.points) {
    const std::size_t count_a = std::min<std::size_t>(100, chunk_a.points - done_a);
    const std::size_t count_b = std::min<std::size_t>(odd ? 300 : 0, chunk_b.points - done_b);
    a.read_both(count_a, batch_a, b, count_b, batch_b);
    expect_points(batch_a, chunk_a.first + done_a);
    expect_points(batch_b, chunk_b.first + done_b);
    done_a += count_a;
    done_b += count_b;
    odd = !odd;
  }
  a.check_end();
  b.check_end();
}

TEST(LazSource, AnUncompressedFileIsNone) {
  SKIP_WITHOUT_LAZ_FILES();
  EXPECT_TRUE(contains(error_of([] { LazSource(laz_file("pdrf5-1.3.las").string()); }),
                       "at byte 104: the points are not compressed"));
  EXPECT_TRUE(contains(error_of([] { LasSource(laz_file("pdrf5-1.3.laz").string()); }),
                       "at byte 104: the points are LAZ-compressed"));
}

// Files whose writer could not, or was not able to, put the place of the table before the points.
class LazTable : public testing::TestWithParam<const char*> {
 protected:
  Bytes bytes() const { return test::bytes_of(laz_file((GetParam() + std::string(".laz")))); }
  Cloud load(const Bytes& bytes) const { return load_all(*open_file(folder_.write("a.laz", bytes))); }
  Cloud expected() const { return load_laz(GetParam() + std::string(".las")); }

  ScratchFolder folder_;
};

TEST_P(LazTable, MayBePointedToByTheLastEightBytes) {
  SKIP_WITHOUT_LAZ_FILES();
  Bytes file = bytes();
  const auto points = get<std::uint32_t>(file, kOffsetToPoints);
  const auto table = get<std::int64_t>(file, points);
  put(file, points, std::int64_t{-1});
  put(file, file.size(), table);
  const Cloud cloud = load(file);
  EXPECT_EQ(cloud.info.warnings, Strings{});
  expect_equal(cloud, expected());
}

TEST_P(LazTable, MayBeMissing) {
  SKIP_WITHOUT_LAZ_FILES();
  Bytes file = bytes();
  const auto points = get<std::uint32_t>(file, kOffsetToPoints);
  const auto table = get<std::int64_t>(file, points);
  put(file, points, static_cast<std::int64_t>(points));
  const Cloud cloud = load(file);
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "interrupted before it wrote the table of chunks"));
  expect_equal(cloud, expected());

  file = bytes();
  file.resize(static_cast<std::size_t>(table) + 4);
  const Cloud cut = load(file);
  EXPECT_TRUE(one_that_contains(cut.info.warnings, "the table of chunks is said to stand at byte"));
  expect_equal(cut, expected());
}

TEST_P(LazTable, MayBeDamaged) {
  SKIP_WITHOUT_LAZ_FILES();
  Bytes file = bytes();
  const auto table = static_cast<std::size_t>(get<std::int64_t>(file, get<std::uint32_t>(file, kOffsetToPoints)));
  put(file, table + 4, std::uint32_t{0xFFFFFFF0});
  Cloud cloud = load(file);
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "4294967280 chunks are stated"));
  expect_equal(cloud, expected());

  file = bytes();
  put(file, table + 8, std::uint64_t{0xFFFFFFFFFFFFFFFF});
  cloud = load(file);
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "the table of chunks"));
  expect_equal(cloud, expected());
}

INSTANTIATE_TEST_SUITE_P(Files, LazTable, testing::Values("pdrf5-1.3", "pdrf8-1.4"),
                         [](const auto& tested) { return std::string(tested.param).substr(0, 5); });

TEST(LazSource, ChunksOfVariableSizeWithoutATableAreAnError) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  Bytes file = test::bytes_of(laz_file("autzen.copc.laz"));
  const auto points = get<std::uint32_t>(file, kOffsetToPoints);
  put(file, points, static_cast<std::int64_t>(points));
  EXPECT_TRUE(contains(error_of([&] { open_file(folder.write("a.laz", file)); }),
                       "Without it, chunks of variable size cannot be found"));
}

}  // namespace
}  // namespace stipple::test::read_laz_source
