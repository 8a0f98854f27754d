// Files of others and of our tests' encoder, decoded by laz-perf, too. Skips without node and without
// `scripts/oracles`.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "tests/oracles/oracle.h"
#include "tests/read/laz_fixture.h"
#include "tests/read/laz_records.h"
#include "tests/read/laz_writer.h"

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

// What we encode for tests is LAZ to others, too: without this, encoder and decoder could be wrong alike. laz-perf
// knows no waveform packets, and of items version 2 and 3.
class LazPerfOfEncoder : public testing::TestWithParam<int> {};

TEST_P(LazPerfOfEncoder, DecodesEveryRecord) {
  SKIP_WITHOUT_ORACLE("laz-perf");
  for (const Kind kind : {Kind::random, Kind::smooth, Kind::constant}) {
    LazLayout layout{GetParam() < 6 ? 2 : 3, {1'500, 1'500, 734}};
    if (kind == Kind::smooth) layout = {layout.version, {2, 1'700, 7, 90}, Chunking::variable};
    const LasFile las = las_for_laz(GetParam(), layout.points());
    const Bytes records = RecordMaker(las, kind, 1).make();
    const ScratchFolder folder;
    const std::string path = folder.write("cloud.laz", LazWriter(las, records, layout).write());
    ASSERT_TRUE(ask_oracle("laz_perf.mjs", path + " " + folder.path("records")));
    EXPECT_TRUE(bytes_of(folder.path("records")) == records) << static_cast<int>(kind);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LazPerfOfEncoder, testing::Values(0, 1, 2, 3, 6, 7, 8));

}  // namespace
}  // namespace stipple::test::read_laz_perf
