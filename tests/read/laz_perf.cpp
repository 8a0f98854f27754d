// Files of every point format, decoded by laz-perf, too. Skips without node and without `scripts/oracles`.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "tests/oracles/oracle.h"

namespace stipple::test::read_laz_perf {
namespace {

class LazPerf : public testing::TestWithParam<const char*> {};

TEST_P(LazPerf, SeesTheSamePoints) {
  SKIP_WITHOUT_ORACLE("laz-perf");
  const std::string path = std::string(STIPPLE_SHARED_DATA "/") + GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Cloud cloud = load_cloud(*open_source(path), {"intensity"});
  std::array<std::int64_t, 3> position{};
  for (const glm::ivec3& point : cloud.positions)
    for (int axis = 0; axis < 3; ++axis) position[axis] += point[axis];
  std::uint64_t intensity = 0;
  for (const std::uint16_t value : cloud.columns.at(0).as<std::uint16_t>()) intensity += value;
  const auto seen = ask_oracle("laz_perf.mjs", path);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->at("points"), cloud.positions.size());
  EXPECT_EQ((seen->at("position").get<std::array<std::int64_t, 3>>()), position);
  EXPECT_EQ(seen->at("intensity"), intensity);
}

INSTANTIATE_TEST_SUITE_P(All, LazPerf,
                         testing::Values("PDAL+PDAL/laz/autzen_trim.laz", "laspy+laspy/data/plane.laz",
                                         "hobuinc+laz-perf/raw-sets/point10.las.laz",
                                         "hobuinc+laz-perf/raw-sets/point-color-time.las.laz",
                                         "hobuinc+laz-perf/raw-sets/1815.laz",
                                         "visgl+loaders.gl/modules/las/test/data/pdrf6-1.4.laz",
                                         "visgl+loaders.gl/modules/las/test/data/pdrf8-1.4.laz",
                                         "visgl+loaders.gl/modules/copc/test/data/ellipsoid-1.4.laz",
                                         "IGNF+ign-pdal-tools/data/test_data_77055_627755_LA93_IGN69_extra_dims.laz"));

}  // namespace
}  // namespace stipple::test::read_laz_perf
