// What the tests of the LAZ reader share.
#pragma once

#include <numeric>

#include "octree/cloud/cloud.h"
#include "octree/read/open.h"
#include "tests/octree/las_fixture.h"
#include "tests/read/read_fixture.h"

namespace stipple::test {

// Small LAZ files that others wrote, and the LAS files they were made from.
inline std::filesystem::path laz_file(const std::string& name) {
  for (const char* folder : {"visgl+loaders.gl/modules/las/test/data", "hobuinc+laz-perf/raw-sets",
                             "laz-rs+laz-rs/data", "gadomski+las-rs/data"}) {
    const std::filesystem::path path = std::filesystem::path(STIPPLE_SHARED_DATA) / folder / name;
    if (std::filesystem::exists(path)) return path;
  }
  return std::filesystem::path(STIPPLE_SHARED_DATA) / name;
}

#define SKIP_WITHOUT_LAZ_FILES() \
  if (!std::filesystem::exists(STIPPLE_SHARED_DATA)) GTEST_SKIP() << STIPPLE_SHARED_DATA << " is not there"

inline Bytes bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Bytes bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

template <class T>
T get(const Bytes& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// How many points read() delivers, all attributes of them.
inline std::uint64_t count_points(const PointSource& source) {
  std::vector<std::size_t> attributes(source.info().schema.size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  std::atomic<std::uint64_t> points{0};
  source.read(attributes, [&](const PointBatch& batch) { points += batch.positions.size(); });
  return points;
}

inline void expect_equal(const Cloud& a, const Cloud& b) {
  EXPECT_EQ(a.info.schema, b.info.schema);
  EXPECT_EQ(a.info.grid.scale, b.info.grid.scale);
  EXPECT_EQ(a.info.grid.offset, b.info.grid.offset);
  // Writers state bounds as they computed them
  for (int axis = 0; axis < 3 && a.size() > 0; ++axis) {
    EXPECT_NEAR(a.info.stated_bounds.min[axis], b.info.stated_bounds.min[axis], 1e-6 * a.info.grid.scale[axis]);
    EXPECT_NEAR(a.info.stated_bounds.max[axis], b.info.stated_bounds.max[axis], 1e-6 * a.info.grid.scale[axis]);
  }
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.positions, b.positions);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t c = 0; c < a.columns.size(); ++c)
    EXPECT_EQ(a.columns[c].bytes, b.columns[c].bytes) << a.columns[c].attribute.name;
}

inline Cloud load_laz(const std::string& name) {
  return load_all(*open_file(laz_file(name).string()));
}

}  // namespace stipple::test
