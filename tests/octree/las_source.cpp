// The LAS reader from file to columns.
#include "octree/read/las/las_source.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "octree/read/open.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::octree_las_source {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::LasFile;
using test::ScratchFolder;

std::vector<std::string> names_of(const Schema& schema) {
  std::vector<std::string> names;
  for (const Attribute& attribute : schema) names.push_back(attribute.name);
  return names;
}

Cloud load_everything(const std::string& path) {
  const auto source = open_source(path);
  return load_cloud(*source, names_of(source->info().schema));
}

template <class T>
T record_value(std::size_t point, std::size_t place) {
  std::uint8_t bytes[sizeof(T)];
  for (std::size_t b = 0; b < sizeof(T); ++b) bytes[b] = LasFile::record_byte(point, place + b);
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Value of attribute `name` of point `i` as stored.
template <class T>
T stored(const Cloud& cloud, const std::string& name, std::size_t i, std::size_t c = 0) {
  const Column* column = cloud.find(name);
  if (!column) throw Error("no attribute " + name);
  EXPECT_EQ(sizeof(T), size_of(column->attribute.type)) << name;
  return column->as<T>()[i * static_cast<std::size_t>(column->attribute.components) + c];
}

void expect_legacy_fields(const Cloud& cloud, std::size_t i) {
  EXPECT_EQ(stored<std::uint16_t>(cloud, "intensity", i), record_value<std::uint16_t>(i, 12));
  const std::uint8_t returns = LasFile::record_byte(i, 14), classes = LasFile::record_byte(i, 15);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "return number", i), returns & 7);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "number of returns", i), returns >> 3 & 7);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "scan direction flag", i), returns >> 6 & 1);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "edge of flight line", i), returns >> 7);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "classification", i), classes & 31);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "classification flags", i), classes >> 5);
  EXPECT_EQ(stored<std::int8_t>(cloud, "scan angle", i), record_value<std::int8_t>(i, 16));
  EXPECT_EQ(stored<std::uint8_t>(cloud, "user data", i), LasFile::record_byte(i, 17));
  EXPECT_EQ(stored<std::uint16_t>(cloud, "point source id", i), record_value<std::uint16_t>(i, 18));
}

void expect_fields_from_format_6(const Cloud& cloud, std::size_t i) {
  EXPECT_EQ(stored<std::uint16_t>(cloud, "intensity", i), record_value<std::uint16_t>(i, 12));
  const std::uint8_t returns = LasFile::record_byte(i, 14), flags = LasFile::record_byte(i, 15);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "return number", i), returns & 15);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "number of returns", i), returns >> 4);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "classification flags", i), flags & 15);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "scanner channel", i), flags >> 4 & 3);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "scan direction flag", i), flags >> 6 & 1);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "edge of flight line", i), flags >> 7);
  EXPECT_EQ(stored<std::uint8_t>(cloud, "classification", i), LasFile::record_byte(i, 16));
  EXPECT_EQ(stored<std::uint8_t>(cloud, "user data", i), LasFile::record_byte(i, 17));
  EXPECT_EQ(stored<std::int16_t>(cloud, "scan angle", i), record_value<std::int16_t>(i, 18));
  EXPECT_EQ(stored<std::uint16_t>(cloud, "point source id", i), record_value<std::uint16_t>(i, 20));
}

// Bits, not values: NaN is as good as any.
template <class T>
void expect_same_bits(const Cloud& cloud, const std::string& name, std::size_t i, std::size_t place,
                      std::size_t c = 0) {
  const T found = stored<T>(cloud, name, i, c), expected = record_value<T>(i, place + c * sizeof(T));
  EXPECT_EQ(std::memcmp(&found, &expected, sizeof(T)), 0) << name << " of point " << i;
}

void expect_waveform(const Cloud& cloud, std::size_t i, std::size_t at) {
  expect_same_bits<std::uint8_t>(cloud, "wave packet descriptor index", i, at);
  expect_same_bits<std::uint64_t>(cloud, "byte offset to waveform data", i, at + 1);
  expect_same_bits<std::uint32_t>(cloud, "waveform packet size", i, at + 9);
  expect_same_bits<float>(cloud, "return point waveform location", i, at + 13);
  expect_same_bits<float>(cloud, "x(t)", i, at + 17);
  expect_same_bits<float>(cloud, "y(t)", i, at + 21);
  expect_same_bits<float>(cloud, "z(t)", i, at + 25);
}

// Byte offsets in the record, 0 where the format has no such field.
struct Places {
  std::size_t time, rgb, nir, waveform;
};
constexpr Places kPlaces[] = {{0, 0, 0, 0},    {20, 0, 0, 0},   {0, 20, 0, 0},   {20, 28, 0, 0},
                              {20, 0, 0, 28},  {20, 28, 0, 34}, {22, 0, 0, 0},   {22, 30, 0, 0},
                              {22, 30, 36, 0}, {22, 0, 0, 30},  {22, 30, 36, 38}};

class LasSourceFormats : public ::testing::TestWithParam<int> {};

TEST_P(LasSourceFormats, EveryFieldOfThePointFormatIsRead) {
  const int format = GetParam();
  const ScratchFolder folder;
  const Cloud cloud =
      load_everything(folder.write("made.las", LasFile{.minor = 4, .format = format, .points = 300}.bytes()));
  ASSERT_EQ(cloud.size(), 300u);
  const Places& places = kPlaces[format];
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto n = static_cast<std::int32_t>(i);
    EXPECT_EQ(cloud.positions[i], glm::ivec3(n, -n, 1000 + n));
    format < 6 ? expect_legacy_fields(cloud, i) : expect_fields_from_format_6(cloud, i);
    if (places.time) expect_same_bits<double>(cloud, "gps-time", i, places.time);
    for (std::size_t c = 0; c < 3 && places.rgb; ++c) expect_same_bits<std::uint16_t>(cloud, "rgb", i, places.rgb, c);
    if (places.nir) expect_same_bits<std::uint16_t>(cloud, "nir", i, places.nir);
    if (places.waveform) expect_waveform(cloud, i, places.waveform);
  }
  EXPECT_EQ(cloud.find("gps-time") != nullptr, places.time != 0);
  EXPECT_EQ(cloud.find("rgb") != nullptr, places.rgb != 0);
  EXPECT_EQ(cloud.find("nir") != nullptr, places.nir != 0);
  EXPECT_EQ(cloud.find("x(t)") != nullptr, places.waveform != 0);
}

INSTANTIATE_TEST_SUITE_P(All, LasSourceFormats, ::testing::Range(0, 11));

TEST(LasSource, ScanAnglesAreInDegreesWhateverTheFormat) {
  const ScratchFolder folder;
  for (const int format : {0, 6}) {
    const Cloud cloud = load_everything(folder.write("made.las", LasFile{.minor = 4, .format = format}.bytes()));
    const double expected = format == 0 ? record_value<std::int8_t>(1, 16) : record_value<std::int16_t>(1, 18) * 0.006;
    EXPECT_DOUBLE_EQ(value_at(*cloud.find("scan angle"), 1), expected);
  }
}

TEST(LasSource, DescribedAndUndescribedExtraBytesAreRead) {
  const ScratchFolder folder;
  const LasFile file{.format = 1, .extra_bytes = 11, .vlrs = {test::extra_bytes_record({{"a", 3}, {"b", 24}})}};
  const Cloud cloud = load_everything(folder.write("made.las", file.bytes()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    expect_same_bits<std::uint16_t>(cloud, "a", i, 28);
    for (std::size_t c = 0; c < 3; ++c) expect_same_bits<std::int16_t>(cloud, "b", i, 30, c);
    for (std::size_t c = 0; c < 3; ++c) expect_same_bits<std::uint8_t>(cloud, "extra bytes", i, 36, c);
  }
}

TEST(LasSource, InfoSaysWhatTheFileIs) {
  const ScratchFolder folder;
  const std::string path = folder.write("made.las", LasFile{.minor = 4, .format = 7, .extra_bytes = 2}.bytes());
  const SourceInfo info = open_source(path)->info();
  EXPECT_EQ(info.path, path);
  EXPECT_EQ(info.format, "LAS");
  EXPECT_EQ(info.version, "1.4");
  EXPECT_EQ(info.encoding, "point format 7, 38 bytes a point");
  EXPECT_EQ(info.point_count, 3u);
  EXPECT_EQ(info.grid.scale, glm::dvec3(0.01, 0.02, 0.5));
  EXPECT_FALSE(info.stated_bounds.empty());
}

TEST(LasSource, BatchesAreDisjointAndCoverEveryPointOnce) {
  const ScratchFolder folder;
  const std::size_t points = 3 * 65'536 + 17;
  const LasSource source(folder.write("made.las", LasFile{.points = points}.bytes()));
  std::mutex mutex;
  std::set<std::int32_t> seen;
  source.read({}, [&](const PointBatch& batch) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(batch.columns.empty());
    for (std::size_t i = 0; i < batch.positions.size(); ++i) {
      EXPECT_EQ(batch.positions[i].x, static_cast<std::int32_t>(batch.first + i));
      EXPECT_TRUE(seen.insert(batch.positions[i].x).second);
    }
  });
  EXPECT_EQ(seen.size(), points);
}

TEST(LasSource, OnlyTheAttributesAskedForAreDeliveredInTheOrderAskedFor) {
  const ScratchFolder folder;
  const LasSource source(folder.write("made.las", LasFile{.format = 3}.bytes()));
  const Schema& schema = source.info().schema;
  const std::vector<std::size_t> wanted{*find_attribute(schema, "rgb"), *find_attribute(schema, "intensity")};
  source.read(wanted, [&](const PointBatch& batch) {
    ASSERT_EQ(batch.columns.size(), 2u);
    EXPECT_EQ(batch.columns[0].attribute.name, "rgb");
    EXPECT_EQ(batch.columns[1].attribute.name, "intensity");
    EXPECT_EQ(batch.columns[0].points(), batch.positions.size());
  });
}

TEST(LasSource, AConsumerThatRunsTasksOfItsOwnKeepsItsBatch) {
  const ScratchFolder folder;
  const LasSource source(folder.write("made.las", LasFile{.points = 60 * 65'536}.bytes()));
  const tbb::global_control more_threads_than_cores(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(8);
  std::atomic<int> changed{0};
  // A thread whose tasks were stolen waits for them, and would take up another batch meanwhile
  const auto pause = [](int i) { std::this_thread::sleep_for(std::chrono::microseconds(100 * i)); };
  const BatchConsumer consume = [&](const PointBatch& batch) {
    const std::uint64_t first = batch.first;
    tbb::parallel_for(0, 16, pause, tbb::simple_partitioner());
    if (batch.first != first || batch.positions[0].x != static_cast<std::int32_t>(first)) ++changed;
  };
  arena.execute([&] { source.read({}, consume); });
  EXPECT_EQ(changed, 0);
}

TEST(LasSource, TheLongestRecordsComeInSmallBatches) {
  const ScratchFolder folder;
  const LasSource source(folder.write("made.las", LasFile{.extra_bytes = 65'515, .points = 200}.bytes()));
  std::atomic<std::size_t> points{0};
  source.read({}, [&](const PointBatch& batch) {
    EXPECT_LE(batch.positions.size() * 65'535, std::size_t{4} << 20);
    points += batch.positions.size();
  });
  EXPECT_EQ(points, 200u);
}

TEST(LasSource, AnErrorOfTheConsumerEndsTheReading) {
  const ScratchFolder folder;
  const LasSource source(folder.write("made.las", LasFile{.points = 200'000}.bytes()));
  EXPECT_EQ(error_of([&] { source.read({}, [](const PointBatch&) { throw Error("enough"); }); }), "enough");
}

TEST(LasSource, MoreThan32BitsOfPointsAreCounted) {
  const ScratchFolder folder;
  const LasFile file{.minor = 4, .format = 6, .points = 1};
  Bytes bytes = file.bytes();
  constexpr std::uint64_t kMany = 5'000'000'000;
  test::put(bytes, las::kPointCount, kMany);
  const std::string path = folder.write("made.las", bytes);
  std::filesystem::resize_file(path, file.points_begin() + kMany * file.record_length());  // a hole, no disk space
  EXPECT_EQ(LasSource(path).info().point_count, kMany);
}

TEST(LasSource, AFileThatShrinksAfterItWasOpenedIsAnError) {
  const ScratchFolder folder;
  const LasFile file{.points = 200'000};
  const std::string path = folder.write("made.las", file.bytes());
  const LasSource source(path);
  std::filesystem::resize_file(path, file.points_end() - 1);
  const std::string message = error_of([&] { source.read({}, [](const PointBatch&) {}); });
  EXPECT_TRUE(contains(message, path + ": at byte " + std::to_string(file.points_end() - 1)));
  EXPECT_TRUE(contains(message, "Another program shortened it"));
}

TEST(OpenSource, AMissingFileIsSaidToBeMissing) {
  EXPECT_TRUE(
      contains(error_of([] { open_source("/nowhere/at/all.las"); }), "/nowhere/at/all.las: there is no such file"));
}

TEST(OpenSource, AFolderIsSaidToBeOne) {
  const ScratchFolder folder;
  EXPECT_TRUE(contains(error_of([&] { open_file(folder.path("")); }), "is a folder"));
}

TEST(OpenSource, AnEmptyFileIsSaidToBeEmpty) {
  const ScratchFolder folder;
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.write("empty.las", {})); }), "at byte 0: the file is empty"));
}

TEST(OpenSource, APipeIsRefusedWithoutWaitingForIt) {
  const ScratchFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("pipe.las").c_str(), 0600), 0);
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.path("pipe.las")); }), "is a device or a pipe"));
}

TEST(OpenSource, AnUnknownFileIsNamedWithItsFirstBytesAndWhatIsRead) {
  const ScratchFolder folder;
  Bytes bytes;
  test::put_text(bytes, 0, std::string_view("PNG\0\x89 and so on", 15));
  const std::string message = error_of([&] { open_source(folder.write("picture.las", bytes)); });
  EXPECT_TRUE(contains(message, folder.path("picture.las")));
  EXPECT_TRUE(contains(message, "50 4e 47 00 89 20 61 6e (PNG.. an)"));
  EXPECT_TRUE(contains(message, "LAS or LAZ 1.0-1.5 with point formats 0-10"));
}

}  // namespace
}  // namespace stipple::test::octree_las_source
