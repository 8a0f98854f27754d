// What write_las() writes, read back by the reader.
#include "octree/read/las/las_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>

#include <csignal>
#include <limits>

#include "octree/cloud/cloud.h"
#include "octree/read/las/las_header.h"
#include "octree/read/las/las_header_block.h"
#include "octree/read/las/las_source.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::octree_las_writer {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::LasFile;
using test::ScratchFolder;
using test::Strings;

constexpr std::size_t kBatch = 1000;

// Points made up by their number, in batches of 1,000 on all cores.
class MadeSource : public PointSource {
 public:
  MadeSource(std::uint64_t points, Schema schema) {
    info_.path = "made";
    info_.point_count = points;
    info_.grid = {{1e6, -2e6, 50.0}, {0.001, 0.002, 0.01}};
    info_.schema = std::move(schema);
  }

  const SourceInfo& info() const override { return info_; }
  SourceInfo& info() { return info_; }

  // Points to deliver, if others than promised.
  std::uint64_t delivered = std::numeric_limits<std::uint64_t>::max();
  std::uint8_t classification = 31;  // the largest

  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override {
    const std::uint64_t count = std::min(delivered, info_.point_count);
    tbb::parallel_for(std::uint64_t{0}, (count + kBatch - 1) / kBatch, [&](std::uint64_t b) {
      PointBatch batch;
      batch.first = b * kBatch;
      batch.positions.resize(std::min<std::uint64_t>(kBatch, count - batch.first));
      for (std::size_t i = 0; i < batch.positions.size(); ++i) batch.positions[i] = position(batch.first + i);
      for (const std::size_t a : attributes) batch.columns.push_back(column(info_.schema[a], batch));
      consume(batch);
    });
  }

  static glm::ivec3 position(std::uint64_t i) {
    const auto n = static_cast<std::int32_t>(i);
    return {n * 7 - 100, 2'000'000'000 - n, -n};
  }
  static std::uint16_t intensity(std::uint64_t i) { return static_cast<std::uint16_t>(i * 31); }
  static std::uint16_t rgb(std::uint64_t i, std::size_t c) { return static_cast<std::uint16_t>(i * 257 + c * 1000); }
  static double time(std::uint64_t i) { return 1.5e8 + static_cast<double>(i) * 1e-6; }
  static std::uint8_t return_number(std::uint64_t i) { return static_cast<std::uint8_t>(i % 8); }

 private:
  Column column(const Attribute& attribute, const PointBatch& batch) const {
    Column column{attribute, {}};
    column.resize(batch.positions.size());
    for (std::size_t k = 0; k < batch.positions.size(); ++k) {
      const std::uint64_t i = batch.first + k;
      if (attribute.name == "intensity") column.as<std::uint16_t>()[k] = intensity(i);
      if (attribute.name == "rgb")
        for (std::size_t c = 0; c < 3; ++c) column.as<std::uint16_t>()[3 * k + c] = rgb(i, c);
      if (attribute.name == "gps-time") column.as<double>()[k] = time(i);
      if (attribute.name == "return number") column.as<std::uint8_t>()[k] = return_number(i);
      if (attribute.name == "number of returns") column.as<std::uint8_t>()[k] = 7;
      if (attribute.name == "classification") column.as<std::uint8_t>()[k] = classification;
    }
    return column;
  }

  SourceInfo info_;
};

const Attribute kRgb{"rgb", ScalarType::u16, 3};
const Attribute kTime{"gps-time", ScalarType::f64};
const Attribute kIntensity{"intensity", ScalarType::u16};
const Attribute kClassification{"classification", ScalarType::u8};
const Attribute kReturnNumber{"return number", ScalarType::u8};
const Attribute kNumberOfReturns{"number of returns", ScalarType::u8};

Cloud write_and_load(const MadeSource& source, const std::vector<std::string>& attributes) {
  const ScratchFolder folder;
  write_las(source, folder.path("out.las"));
  return load_cloud(LasSource(folder.path("out.las")), attributes);
}

TEST(LasWriter, ThePointFormatFollowsFromColourAndTime) {
  EXPECT_EQ(write_and_load({5, {}}, {}).info.encoding, "point format 0, 20 bytes a point");
  EXPECT_EQ(write_and_load({5, {kTime}}, {}).info.encoding, "point format 1, 28 bytes a point");
  EXPECT_EQ(write_and_load({5, {kRgb}}, {}).info.encoding, "point format 2, 26 bytes a point");
  EXPECT_EQ(write_and_load({5, {kRgb, kTime}}, {}).info.encoding, "point format 3, 34 bytes a point");
}

TEST(LasWriter, PositionsAndGridComeBackUntouchedInTheirOrder) {
  const MadeSource source(123'456, {});
  const Cloud cloud = write_and_load(source, {});
  ASSERT_EQ(cloud.size(), 123'456u);
  EXPECT_EQ(cloud.info.grid.scale, source.info().grid.scale);
  EXPECT_EQ(cloud.info.grid.offset, source.info().grid.offset);
  for (std::size_t i = 0; i < cloud.size(); ++i) ASSERT_EQ(cloud.positions[i], MadeSource::position(i));
  EXPECT_EQ(cloud.info.warnings, Strings{});
}

TEST(LasWriter, EveryWrittenAttributeComesBack) {
  const MadeSource source(2500, {kRgb, kTime, kIntensity, kClassification, kReturnNumber, kNumberOfReturns});
  const Cloud cloud =
      write_and_load(source, {"rgb", "gps-time", "intensity", "classification", "return number", "number of returns"});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_EQ(cloud.find("rgb")->as<std::uint16_t>()[3 * i + c], MadeSource::rgb(i, c));
    ASSERT_EQ(cloud.find("gps-time")->as<double>()[i], MadeSource::time(i));
    ASSERT_EQ(cloud.find("intensity")->as<std::uint16_t>()[i], MadeSource::intensity(i));
    ASSERT_EQ(cloud.find("classification")->as<std::uint8_t>()[i], 31);
    ASSERT_EQ(cloud.find("return number")->as<std::uint8_t>()[i], MadeSource::return_number(i));
    ASSERT_EQ(cloud.find("number of returns")->as<std::uint8_t>()[i], 7);
  }
}

TEST(LasWriter, WhatTheSourceLacksIsZeroAndTheReturnTheOnlyOne) {
  const Cloud cloud =
      write_and_load({5, {}}, {"intensity", "classification", "return number", "number of returns", "user data"});
  EXPECT_EQ(value_at(*cloud.find("intensity"), 4), 0.0);
  EXPECT_EQ(value_at(*cloud.find("classification"), 4), 0.0);
  EXPECT_EQ(value_at(*cloud.find("user data"), 4), 0.0);
  EXPECT_EQ(value_at(*cloud.find("return number"), 4), 1.0);
  EXPECT_EQ(value_at(*cloud.find("number of returns"), 4), 1.0);
}

TEST(LasWriter, StatedBoundsAreThoseOfThePoints) {
  const Cloud cloud = write_and_load({5000, {}}, {});
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  EXPECT_EQ(cloud.info.stated_bounds.min, box.min);
  EXPECT_EQ(cloud.info.stated_bounds.max, box.max);
}

TEST(LasWriter, ACloudWithoutPointsIsWritten) {
  const Cloud cloud = write_and_load({0, {kRgb}}, {});
  EXPECT_EQ(cloud.size(), 0u);
  EXPECT_EQ(cloud.info.warnings, Strings{});
}

TEST(LasWriter, ALasFileComesBackFromAReadAndAWrite) {
  const ScratchFolder folder;
  const LasSource first(folder.write("first.las", LasFile{.minor = 2, .format = 3, .points = 1000}.bytes()));
  write_las(first, folder.path("second.las"));
  const LasSource second(folder.path("second.las"));
  const std::vector<std::string> names{"rgb",           "gps-time",         "intensity", "classification",
                                       "return number", "number of returns"};
  const Cloud a = load_cloud(first, names), b = load_cloud(second, names);
  EXPECT_EQ(a.positions, b.positions);
  for (std::size_t c = 0; c < names.size(); ++c) EXPECT_EQ(a.columns[c].bytes, b.columns[c].bytes) << names[c];
}

template <class T>
T at(const Bytes& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(LasWriter, CountsByReturnAreThoseOfThePointsInBothWidths) {
  const ScratchFolder folder;
  write_las(MadeSource(2003, {kReturnNumber}), folder.path("out.las"));
  Bytes bytes(las::kWrittenHeaderSize);
  std::ifstream(folder.path("out.las"), std::ios::binary)
      .read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  // 2003 points with return numbers 0, 1, ... 7, 0, ...: 251 of 0 to 2, 250 of the others
  for (std::size_t r = 1; r <= 15; ++r) {
    const std::uint64_t expected = r > 7 ? 0 : r <= 2 ? 251 : 250;
    EXPECT_EQ(at<std::uint64_t>(bytes, las::kCountsByReturn + 8 * (r - 1)), expected) << r;
  }
  for (std::size_t r = 1; r <= 5; ++r)
    EXPECT_EQ(at<std::uint32_t>(bytes, las::kLegacyCountsByReturn + 4 * (r - 1)), r <= 2 ? 251u : 250u) << r;
  EXPECT_EQ(at<std::uint32_t>(bytes, las::kLegacyPointCount), 2003u);
  EXPECT_EQ(at<std::uint64_t>(bytes, las::kPointCount), 2003u);
}

TEST(LasWriter, LegacyCountsAreZeroWhere32BitsDoNotHoldThem) {
  las::HeaderContent content;
  content.point_count = std::uint64_t{1} << 32;
  content.counts_by_return[0] = content.point_count;
  const auto block = las::header_block(content);
  const Bytes bytes(block.begin(), block.end());
  EXPECT_EQ(at<std::uint64_t>(bytes, las::kPointCount), content.point_count);
  EXPECT_EQ(at<std::uint64_t>(bytes, las::kCountsByReturn), content.point_count);
  EXPECT_EQ(at<std::uint32_t>(bytes, las::kLegacyPointCount), 0u);
  EXPECT_EQ(at<std::uint32_t>(bytes, las::kLegacyCountsByReturn), 0u);
}

TEST(LasWriter, EqualPointsMakeEqualFiles) {
  const ScratchFolder folder;
  const auto content = [&](const std::string& name) {
    write_las(MadeSource(20'000, {kRgb}), folder.path(name));
    std::ifstream in(folder.path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(content("a.las"), content("b.las"));
}

TEST(LasWriter, OnlyTheFileItselfIsLeft) {
  const ScratchFolder folder;
  write_las(MadeSource(5000, {}), folder.path("out.las"));
  EXPECT_EQ(folder.names(), (Strings{"out.las"}));
}

// Runs write_las() to an existing file, expects an Error, and that the folder is as it was before.
std::string error_that_leaves_nothing(const MadeSource& source) {
  const ScratchFolder folder;
  const std::string path = folder.write("out.las", Bytes(3));
  const std::string message = error_of([&] { write_las(source, path); });
  EXPECT_EQ(folder.names(), (Strings{"out.las"}));
  EXPECT_EQ(std::filesystem::file_size(path), 3u);
  EXPECT_TRUE(contains(message, path));
  return message;
}

TEST(LasWriter, ColoursThatAreNot16BitAreRefused) {
  EXPECT_TRUE(contains(error_that_leaves_nothing({10, {{"rgb", ScalarType::u8, 3}}}),
                       "attribute \"rgb\" is uint8 x 3 (scale 1, offset 0), and uint16 x 3, unscaled, was expected"));
}

TEST(LasWriter, ClassesThatNeedMoreThanFiveBitsAreRefused) {
  MadeSource source(10, {kClassification});
  source.classification = 32;
  EXPECT_TRUE(contains(error_that_leaves_nothing(source), "classification 32"));
}

TEST(LasWriter, ASourceThatDeliversTooFewPointsIsRefused) {
  MadeSource source(5000, {});
  source.delivered = 4000;
  EXPECT_TRUE(contains(error_that_leaves_nothing(source), "promised 5000 points and delivered 4000"));
}

class OverlongSource : public PointSource {
 public:
  const SourceInfo& info() const override { return info_; }
  void read(std::span<const std::size_t>, const BatchConsumer& consume) const override {
    PointBatch batch;
    batch.first = std::numeric_limits<std::uint64_t>::max();
    batch.positions.resize(1);
    consume(batch);
  }

 private:
  SourceInfo info_;
};

TEST(LasWriter, APointBeyondThePromisedOnesIsRefused) {
  const ScratchFolder folder;
  EXPECT_TRUE(contains(error_of([&] { write_las(OverlongSource(), folder.path("out.las")); }), "promised 0 points"));
  EXPECT_EQ(folder.names(), Strings{});
}

TEST(LasWriter, AFullDiskIsReportedWithPathAndReason) {
  // A limit on the size of files stands in for a full disk: pwrite() fails half-way through the points.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit limited = before;
  limited.rlim_cur = 100'000;
  ::setrlimit(RLIMIT_FSIZE, &limited);
  const std::string message = error_that_leaves_nothing({50'000, {}});
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(contains(message, "cannot write"));
  EXPECT_TRUE(contains(message, "File too large"));
}

TEST(LasWriter, AFolderThatDoesNotExistIsReported) {
  const std::string message = error_of([] { write_las(MadeSource(5, {}), "/nowhere/at/all/out.las"); });
  EXPECT_TRUE(contains(message, "/nowhere/at/all/out.las: cannot create"));
  EXPECT_TRUE(contains(message, "No such file or directory"));
}

TEST(LasWriter, AFolderInThePlaceOfTheFileIsReportedAndLeftAlone) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("out.las"));
  EXPECT_TRUE(
      contains(error_of([&] { write_las(MadeSource(5, {}), folder.path("out.las")); }), "name a file to write"));
  EXPECT_EQ(folder.names(), (Strings{"out.las"}));
}

}  // namespace
}  // namespace stipple::test::octree_las_writer
