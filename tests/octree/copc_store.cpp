// COPC files as trees: a small bundled one, taken apart, and the real ones of the shared data where they are there.
#include "octree/store/copc/copc_store.h"

#include <random>

#include "octree/open/open.h"
#include "octree/read/laz/laz_source.h"
#include "octree/store/open_tree.h"
#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "tests/read/laz_fixture.h"
#include "tests/read/shared_catalog.h"

namespace stipple::test::octree_copc_store {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::get;
using test::laz_file;
using test::load_all;
using test::put;
using test::ScratchFolder;

const std::filesystem::path kData = STIPPLE_SHARED_DATA;
const std::filesystem::path kSmall = laz_file("autzen.copc.laz");

constexpr std::size_t kInfo = 375 + 54;  // body of the record, first behind the header
constexpr std::size_t kRootPage = kInfo + 40;
constexpr std::size_t kRootPageBytes = kInfo + 48;

// The values of all points, in an order that does not depend on that of the file.
std::vector<std::string> sorted_points(const Cloud& cloud) {
  std::vector<std::string> points(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto append = [&](const void* from, std::size_t count) {
      points[i].append(static_cast<const char*>(from), count);
    };
    append(&cloud.positions[i], sizeof(glm::ivec3));
    for (const Column& column : cloud.columns)
      append(column.bytes.data() + i * column.attribute.bytes(), column.attribute.bytes());
  }
  std::ranges::sort(points);
  return points;
}

void expect_the_points_of_the_file(const std::string& path) {
  const auto tree = open_source(path);
  EXPECT_EQ(tree->info().format, "COPC");
  EXPECT_EQ(tree->info().warnings, test::Strings{});
  const LazSource file(path);
  EXPECT_EQ(tree->info().point_count, file.info().point_count);
  EXPECT_EQ(tree->info().schema, file.info().schema);
  EXPECT_EQ(sorted_points(load_all(*tree)), sorted_points(load_all(file)));
}

TEST(CopcStore, HoldsThePointsOfTheFile) {
  SKIP_WITHOUT_LAZ_FILES();
  expect_the_points_of_the_file(kSmall);
}

TEST(CopcStore, InfoIsThatOfTheRecords) {
  SKIP_WITHOUT_LAZ_FILES();
  const CopcStore store(kSmall);
  const TreeInfo& info = store.info();
  EXPECT_EQ(info.source.version, "1.0");
  EXPECT_EQ(info.source.encoding, "LAZ 1.4, point format 7, 36 bytes a point unpacked, items of version 3");
  const Bytes bytes = test::bytes_of(kSmall);
  EXPECT_EQ(info.cube.edge, 2.0 * get<double>(bytes, kInfo + 24));
  EXPECT_EQ(info.cube.min.x, get<double>(bytes, kInfo) - get<double>(bytes, kInfo + 24));
  EXPECT_EQ(info.spacing, get<double>(bytes, kInfo + 32));
  EXPECT_FALSE(store.reads_parts());
}

TEST(CopcStore, OpeningReadsTheHeaderAndTheFirstPage) {
  SKIP_WITHOUT_LAZ_FILES();
  const CopcStore store(kSmall);
  const Bytes bytes = test::bytes_of(kSmall);
  EXPECT_EQ(store.bytes_read(), get<std::uint32_t>(bytes, 96) + get<std::uint64_t>(bytes, kRootPageBytes));
}

TEST(CopcStore, IsToldFromOtherLazByItsFirstRecord) {
  SKIP_WITHOUT_LAZ_FILES();
  EXPECT_TRUE(is_tree(kSmall));
  EXPECT_FALSE(is_tree(laz_file("pdrf8-1.4.laz")));
  EXPECT_FALSE(is_tree(laz_file("point10-1.0.las")));
}

TEST(CopcStore, AttributesAreTheSameWhenNothingElseIsAskedFor) {
  SKIP_WITHOUT_LAZ_FILES();
  const auto source = open_source(kSmall);
  const Cloud all = load_all(*source);
  for (const Column& column : all.columns) {
    const Cloud one = load_cloud(*source, {column.attribute.name});
    EXPECT_EQ(one.positions, all.positions);
    EXPECT_EQ(one.columns.at(0).bytes, column.bytes) << column.attribute.name;
  }
}

// Writes one entry of a page.
void put_entry(Bytes& page, std::size_t at, std::array<std::int32_t, 4> key, std::uint64_t offset, std::int32_t bytes,
               std::int32_t points) {
  put(page, at, key);
  put(page, at + 16, offset);
  put(page, at + 24, bytes);
  put(page, at + 28, points);
}

// The small file with another hierarchy, which stands at its end.
class CopcHierarchy : public testing::Test {
 protected:
  // Entries of the first page.
  template <class... Entries>
  void set_page(const Entries&... entries) {
    const std::size_t page = file_.size();
    std::size_t at = page;
    (entries(file_, std::exchange(at, at + 32)), ...);
    put(file_, kRootPage, static_cast<std::uint64_t>(page));
    put(file_, kRootPageBytes, static_cast<std::uint64_t>(file_.size() - page));
  }
  static auto entry(std::array<std::int32_t, 4> key, std::uint64_t offset, std::int32_t bytes, std::int32_t points) {
    return [=](Bytes& file, std::size_t at) { put_entry(file, at, key, offset, bytes, points); };
  }
  std::string write() const { return folder_.write("a.copc.laz", file_); }
  std::string error() const {
    return error_of([&] { load_all(*open_source(write())); });
  }

  ScratchFolder folder_;
  Bytes file_ = test::bytes_of(kSmall);
  std::uint64_t chunk_ = get<std::uint32_t>(file_, 96) + 8;
  std::int32_t chunk_bytes_ = static_cast<std::int32_t>(get<std::uint64_t>(file_, chunk_ - 8) - chunk_);
};

TEST_F(CopcHierarchy, ChildrenAreOrderedByXThenYThenZ) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({1, 1, 0, 0}, chunk_, chunk_bytes_, 107), entry({1, 0, 0, 1}, 0, 0, 0), entry({0, 0, 0, 0}, 0, 0, 0));
  const CopcStore store(write());
  const auto piece = store.root_piece();
  ASSERT_EQ(piece.nodes.size(), 3u);
  EXPECT_EQ(piece.nodes[piece.nodes[0].children[4]].points, 107u);
  EXPECT_EQ(piece.nodes[piece.nodes[0].children[1]].points, 0u);
  EXPECT_EQ(name_of(piece.nodes[piece.nodes[0].children[4]]), "r4");
}

TEST_F(CopcHierarchy, PagesAreReadWhenAskedFor) {
  SKIP_WITHOUT_LAZ_FILES();
  const std::uint64_t second = file_.size();
  put_entry(file_, second, {1, 0, 1, 0}, chunk_, chunk_bytes_, 107);
  set_page(entry({0, 0, 0, 0}, 0, 0, 0), entry({1, 0, 1, 0}, second, 32, -1));
  const CopcStore store(write());
  const auto piece = store.root_piece();
  ASSERT_EQ(piece.continued.size(), 1u);
  EXPECT_EQ(piece.continued[0].piece, second);
  EXPECT_EQ(load_all(*open_source(write())).size(), 107u);
}

TEST_F(CopcHierarchy, APageThatLeadsToItselfIsAnError) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({0, 0, 0, 0}, file_.size(), 32, -1));
  EXPECT_TRUE(contains(error(), "begins with a reference to another page for node 0-0-0-0"));
}

TEST_F(CopcHierarchy, ANodeWithoutAParentIsAnError) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({0, 0, 0, 0}, chunk_, chunk_bytes_, 107), entry({2, 0, 0, 0}, chunk_, chunk_bytes_, 107));
  EXPECT_TRUE(contains(error(), "has an entry of node 2-0-0-0, whose parent has none in it"));
}

TEST_F(CopcHierarchy, ANodeThatOccursTwiceIsAnError) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({0, 0, 0, 0}, chunk_, chunk_bytes_, 107), entry({0, 0, 0, 0}, chunk_, chunk_bytes_, 107));
  EXPECT_TRUE(contains(error(), "has node 0-0-0-0 twice"));
}

TEST_F(CopcHierarchy, BytesBeyondTheFileAreAnError) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({0, 0, 0, 0}, chunk_, 0x7FFFFFFF, 107));
  EXPECT_TRUE(contains(error(), "states bytes"));
  put(file_, kRootPage, std::uint64_t{1} << 40);
  EXPECT_TRUE(contains(error(), "a hierarchy page was expected in bytes 1099511627776"));
}

TEST_F(CopcHierarchy, AChunkOfAnotherNumberOfPointsIsAnErrorThatNamesTheNode) {
  SKIP_WITHOUT_LAZ_FILES();
  set_page(entry({0, 0, 0, 0}, chunk_, chunk_bytes_, 106));
  EXPECT_TRUE(contains(error(), "states 107 points itself"));
  EXPECT_TRUE(contains(error(), "It holds node r."));
}

TEST_F(CopcHierarchy, MorePointsThanTheBytesCanHoldAreAnErrorBeforeTheyAreMadeRoomFor) {
  SKIP_WITHOUT_LAZ_FILES();
  put(file_, chunk_ + 36, std::int32_t{2'000'000'000});
  put(file_, 247, std::uint64_t{2'000'000'000});
  put(file_, 107, std::uint32_t{0});
  set_page(entry({0, 0, 0, 0}, chunk_, chunk_bytes_, 2'000'000'000));
  const CopcStore store(write());
  PointBatch batch;
  EXPECT_TRUE(contains(error_of([&] { store.read_points(store.root_piece().nodes[0], {}, batch); }), ": at byte "));
  EXPECT_EQ(batch.positions.capacity(), 0u);
}

TEST(CopcRobustness, ADamagedFileIsAnErrorOrReadWhole) {
  SKIP_WITHOUT_LAZ_FILES();
  const ScratchFolder folder;
  const Bytes whole = test::bytes_of(kSmall);
  std::mt19937 random(2'021);
  int refused = 0;
  for (int i = 0; i < 1'000; ++i) {
    Bytes bytes = whole;
    for (std::size_t places = 1 + random() % 4; places > 0; --places) {
      // Header and records, the hierarchy behind the points, or anywhere
      const std::size_t begins[] = {24, bytes.size() - 150, 0};
      const std::size_t lengths[] = {600, 150, bytes.size()};
      const std::size_t part = random() % 3;
      bytes[begins[part] + random() % lengths[part]] = static_cast<std::byte>(random());
    }
    try {
      const auto source = open_source(folder.write("damaged.copc.laz", bytes));
      ASSERT_EQ(test::count_points(*source), source->info().point_count);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

class CopcCatalog : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_WITHOUT_CATALOG(); }
  std::string path_ = kData / GetParam();
};

TEST_P(CopcCatalog, HoldsThePointsOfTheFile) {
  SKIP_WITHOUT_LAZ_FILES();
  expect_the_points_of_the_file(path_);
}

TEST_P(CopcCatalog, Checks) {
  SKIP_WITHOUT_LAZ_FILES();
  const CopcStore store(path_);
  const TreeReport report = check_tree(store);
  EXPECT_FALSE(report.defect) << report.defect->node << ": " << report.defect->what;
  EXPECT_EQ(report.points, store.info().source.point_count);
}

INSTANTIATE_TEST_SUITE_P(Files, CopcCatalog,
                         testing::Values("potree+potree/lion_takanawa.copc.laz", "PDAL+PDAL/copc/lone-star.copc.laz",
                                         "visgl+loaders.gl/modules/copc/test/data/ellipsoid.copc.laz",
                                         "laspy+laspy/data/simple_with_page.copc.laz",
                                         "PDAL+PDAL/copc/1.2-with-color.copc.laz",
                                         "gadomski+las-rs/data/autzen.copc.laz"),
                         [](const auto& tested) {
                           std::string name = std::filesystem::path(tested.param).stem().stem();
                           std::ranges::replace_if(
                               name, [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(CopcPages, AHierarchyOfTwoPagesHasAllNodes) {
  SKIP_WITHOUT_LAZ_FILES();
  const std::filesystem::path path = kData / "laspy+laspy/data/simple_with_page.copc.laz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  const CopcStore store(path);
  EXPECT_EQ(store.root_piece().continued.size(), 1u);
  EXPECT_EQ(read_whole_hierarchy(store).size(), 65u);
}

}  // namespace
}  // namespace stipple::test::octree_copc_store
