// What every tree must hold, on clouds made to break it.
#include <array>
#include <map>

#include "octree/build/morton.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::octree_stream_build_clouds {
namespace {

class StreamBuildCloud : public StreamBuild, public testing::WithParamInterface<TestCloud> {};

void expect_inside(const ReadNode& node, const Quantizer& quantizer) {
  for (const glm::ivec3& p : node.points.positions)
    ASSERT_EQ(morton_decode(quantizer.code(p) >> bits_below(node.node.level)), node.node.cell) << name_of(node.node);
}

void expect_apart(const ReadNode& node, const TreeInfo& info) {
  const double spacing = std::ldexp(info.spacing, -node.node.level);
  const glm::dvec3 scale = info.source.grid.scale / spacing;
  std::map<std::array<std::int64_t, 3>, std::vector<glm::dvec3>> bins;  // one spacing wide
  for (const glm::ivec3& p : node.points.positions) {
    const glm::dvec3 place = glm::dvec3(p) * scale;
    const glm::dvec3 bin = glm::floor(place);
    for (int n = 0; n < 27; ++n) {
      const auto found =
          bins.find({static_cast<std::int64_t>(bin.x) + n % 3 - 1, static_cast<std::int64_t>(bin.y) + n / 3 % 3 - 1,
                     static_cast<std::int64_t>(bin.z) + n / 9 - 1});
      if (found == bins.end()) continue;
      for (const glm::dvec3& other : found->second)
        ASSERT_GE(glm::distance(place, other), kPoissonFraction) << name_of(node.node);
    }
    bins[{static_cast<std::int64_t>(bin.x), static_cast<std::int64_t>(bin.y), static_cast<std::int64_t>(bin.z)}]
        .push_back(place);
  }
}

TEST_P(StreamBuildCloud, HoldsEveryPointOnceWithAllAttributesInsideItsCell) {
  for (const Sampling sampling : {Sampling::poisson, Sampling::random}) {
    StreamOptions options = small_nodes();
    options.sampling = sampling;
    options.replace = true;
    const Sources sources = sources_of(GetParam());
    build(sources, "tree", options);
    const ReadTree tree = read_tree(path("tree"));
    EXPECT_EQ(tree.info.source.point_count, GetParam().positions.size());
    ASSERT_EQ(tree.sorted_records(), sorted_records(*sources.front()));
    if (GetParam().positions.empty()) continue;
    const Quantizer quantizer(GetParam().grid, GetParam().bounds());
    for (const ReadNode& node : tree.nodes) expect_inside(node, quantizer);
  }
}

TEST_P(StreamBuildCloud, PoissonKeepsPointsOfInnerNodesApart) {
  build(sources_of(GetParam()), "tree", small_nodes());
  const ReadTree tree = read_tree(path("tree"));
  for (const ReadNode& node : tree.nodes)
    if (!node.node.is_leaf()) expect_apart(node, tree.info);
}

TEST_P(StreamBuildCloud, IsTheSameByteForByteWhateverThreadsMemoryAndOrder) {
  StreamOptions options = small_nodes();
  options.threads = 2;
  build(sources_of(GetParam()), "a", options);
  TestCloud half = GetParam(), rest = GetParam();
  const auto middle = static_cast<std::ptrdiff_t>(half.positions.size() / 2);
  half.positions.resize(static_cast<std::size_t>(middle));
  rest.positions.erase(rest.positions.begin(), rest.positions.begin() + middle);
  Sources reversed;  // the same points, in two files, the last first
  reversed.push_back(std::make_unique<CloudSource>(rest, middle));
  reversed.push_back(std::make_unique<CloudSource>(half));
  options.threads = 1;
  options.most_in_memory = 7'000;
  build(reversed, "b", options);
  // A heap of one code beyond memory keeps the order in which its points came
  const bool heap = GetParam().name == "equal";
  for (const char* name : {"hierarchy.bin", "octree.bin", "stipple.bin"})
    EXPECT_TRUE(heap || file_content(path("a") + "/" + name) == file_content(path("b") + "/" + name)) << name;
  EXPECT_EQ(read_tree(path("a")).sorted_records(), read_tree(path("b")).sorted_records());
}

TEST_P(StreamBuildCloud, BrotliHoldsTheSamePointsInTheSameNodesAndOrder) {
  StreamOptions options = small_nodes();
  build(sources_of(GetParam()), "plain", options);
  options.encoding = potree2::Encoding::brotli;
  build(sources_of(GetParam()), "packed", options);
  const ReadTree plain = read_tree(path("plain"));
  const ReadTree packed = read_tree(path("packed"));
  ASSERT_EQ(packed.nodes.size(), plain.nodes.size());
  for (std::size_t n = 0; n < plain.nodes.size(); ++n) {
    EXPECT_EQ(name_of(packed.nodes[n].node), name_of(plain.nodes[n].node));
    EXPECT_TRUE(records_of(packed.nodes[n].points) == records_of(plain.nodes[n].points))
        << name_of(plain.nodes[n].node);
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds, StreamBuildCloud, testing::ValuesIn(test_clouds()), cloud_name);

}  // namespace
}  // namespace stipple::test::octree_stream_build_clouds
