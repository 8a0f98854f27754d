// Every real PLY, PCD, OBJ and text file of the shared data, where they are there.
#include <map>

#include "tests/read/read_fixture.h"
#include "tests/read/shared_catalog.h"

namespace stipple::test::read_catalog {
namespace {

// What these have to be refused with.
const std::map<std::string, std::string> kRefused = {
    // The header breaks off in a property; the 8 points that it states are not there
    {"assimp+assimp/test/models/invalid/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply",
     "at byte 112: the header ends here"},
    // No element "vertex"
    {"PDAL+PDAL/ply/no_vertex.ply", "at byte 0: the header declares no element \"vertex\""},
    {"mikedh+trimesh/models/emptyIO/ply_empty_header.ply", "at byte 0: the header declares no element \"vertex\""},
    // No byte at all
    {"assimp+assimp/test/models/invalid/empty.ply", "at byte 0: the file is empty"},
};

// What these have, though the catalogue states no number.
const std::map<std::string, std::uint64_t> kUnlisted = {
    // displaz's own layout: an element for each attribute
    {"c42f+displaz/test/displaz_ply_points.ply", 20},
    // Lines of numbers without a header are text, whatever the name of the file
    {"PDAL+PDAL/pcd/missingheader.pcd", 10},
};

std::vector<CatalogEntry> entries() {
  return catalog_entries({"PLY", "PCD", "OBJ", "XYZ"});
}

class TableCatalog : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_CATALOG(); }
  static Cloud load(const std::string& path) { return load_all(*open_source((kSharedData / path).string())); }
};

TEST_F(TableCatalog, EveryFileHasItsPointsOrIsAnErrorThatNamesThePlace) {
  std::size_t files = 0;
  for (const CatalogEntry& entry : entries()) {
    const std::string& path = entry.path;
    SCOPED_TRACE(path);
    ++files;
    if (const auto refused = kRefused.find(path); refused != kRefused.end()) {
      EXPECT_TRUE(contains(error_of([&] { load(path); }), (kSharedData / path).string() + ": " + refused->second));
      continue;
    }
    const auto unlisted = kUnlisted.find(path);
    const std::uint64_t expected = unlisted != kUnlisted.end() ? unlisted->second : entry.count().value();
    const Cloud cloud = load(path);
    // The catalogue counts points without a position, too
    EXPECT_EQ(cloud.info.point_count + cloud.info.dropped_points, expected);
    EXPECT_EQ(cloud.size(), cloud.info.point_count);
  }
  EXPECT_EQ(files, 96u);
}

TEST_F(TableCatalog, OnlyTheOrganisedCloudHasHoles) {
  for (const CatalogEntry& entry : entries()) {
    const std::string& path = entry.path;
    if (kRefused.contains(path)) continue;
    const bool organised = path.ends_with("milk_cartoon_all_small_clorox.pcd");
    EXPECT_EQ(open_source((kSharedData / path).string())->info().dropped_points, organised ? 65'793u : 0u) << path;
  }
}

void expect_same_points(const Cloud& a, const Cloud& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  const auto first = worlds(a), second = worlds(b);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(first[i][axis], second[i][axis], tolerance) << i;
}

TEST_F(TableCatalog, TheSameCloudInTwoEncodingsIsTheSame) {
  const std::string happly = "nmwsharp+happly/test/sampledata/platonic_shelf";
  expect_same_points(load(happly + ".ply"), load(happly + "_ascii.ply"), 1e-6);
  expect_same_points(load(happly + ".ply"), load(happly + "_big_endian.ply"), 0.0);
  const std::string ripple = "visgl+loaders.gl/cpp/Model3DTiler/test/resources/ripple_";
  const Cloud ascii = load(ripple + "ascii.ply"), binary = load(ripple + "bin.ply");
  expect_same_points(ascii, binary, 1e-6);
  EXPECT_EQ(values(ascii, "rgb"), values(binary, "rgb"));
  expect_same_points(load("PDAL+PDAL/pcd/utm17_comma.pcd"), load("PDAL+PDAL/pcd/utm17_tab.pcd"), 0.0);
  expect_same_points(load("PDAL+PDAL/pcd/missingheader.pcd"), load("PDAL+PDAL/pcd/utm17_space.pcd"), 0.0);
  const std::string displaz = "c42f+displaz/test/";
  const Cloud own = load(displaz + "displaz_ply_points.ply"), standard = load(displaz + "standard_ply_points.ply");
  expect_same_points(own, standard, 0.0);
  EXPECT_EQ(values(own, "rgb"), values(standard, "rgb"));
  EXPECT_EQ(values(own, "nx"), values(standard, "nx"));
}

TEST_F(TableCatalog, CentimetresOfAsciiCoordinatesAreKept) {
  const auto read = worlds(load("PDAL+PDAL/pcd/utm17_space.pcd"));
  EXPECT_DOUBLE_EQ(read[0].y, 4320978.61);
  EXPECT_DOUBLE_EQ(read[9].x, 289818.50);
}

TEST_F(TableCatalog, ColorsAreWhatTheirFilesSay) {
  EXPECT_EQ(values(load("assimp+assimp/test/models/PLY/float-color.ply"), "rgb").size(), 9u);
  const Cloud odd = load("PDAL+PDAL/ply/text_extradim.ply");
  EXPECT_EQ(values(odd, "rgb"), (std::vector<double>{63 * 257, 200 * 257, 64 * 257}));
  EXPECT_EQ(values(odd, "omg"), std::vector<double>{1234});
  const auto las = open_source((kSharedData / "PDAL+PDAL/pcd/autzen-utm.pcd").string());
  EXPECT_TRUE(find_attribute(las->info().schema, "gps-time"));
  EXPECT_TRUE(find_attribute(las->info().schema, "rgb"));
}

}  // namespace
}  // namespace stipple::test::read_catalog
