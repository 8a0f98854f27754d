// The shuffle on the GPU against its twin on the CPU, and both against what a shuffle must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "render/gpu/program.h"
#include "render/store/gpu_cloud.h"
#include "tests/octree/las_fixture.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_shuffle {
namespace {

constexpr std::uint64_t kSeeds[] = {0, 1, 4'294'967'295ull, 12'345'678'901'234'567ull};

PackedPoint point_number(std::uint32_t i) {
  return {glm::ivec3(static_cast<int>(i), -static_cast<int>(i), static_cast<int>(i * 2654435761u)), i ^ 0xFF00FF00u};
}

bool same(const PackedPoint& a, const PackedPoint& b) {
  return a.position == b.position && a.rgba == b.rgba;
}

PointSet numbered_points(std::uint32_t count) {
  PointSet set;
  set.points.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) set.points[i] = point_number(i);
  return set;
}

// What the buffers of a cloud hold, slot by slot.
struct Slots {
  std::vector<PackedPoint> points;
  std::vector<std::uint32_t> ids;
};

Slots download(GpuCloud& cloud) {
  Slots slots{std::vector<PackedPoint>(cloud.size()), std::vector<std::uint32_t>(cloud.size())};
  std::size_t first = 0;
  for (const GpuCloud::Chunk& chunk : cloud.chunks()) {
    chunk.points.read(0, slots.points.data() + first, chunk.points.bytes());
    chunk.ids.read(0, slots.ids.data() + first, chunk.ids.bytes());
    first += chunk.points.bytes() / sizeof(PackedPoint);
  }
  EXPECT_EQ(first, cloud.size());
  return slots;
}

bool is_permutation_of_indices(std::vector<std::uint32_t> slots) {
  std::ranges::sort(slots);
  for (std::uint32_t i = 0; i < slots.size(); ++i)
    if (slots[i] != i) return false;
  return true;
}

TEST(ShufflePrime, IsTheLargestThatIsThreeModuloFour) {
  constexpr std::uint32_t kLast = 20'000;
  std::vector<bool> composite(kLast + 1);
  std::uint32_t largest = 0;
  for (std::uint32_t n = 0; n <= kLast; ++n) {
    if (n >= 2 && !composite[n]) {
      for (std::uint32_t multiple = 2 * n; multiple <= kLast; multiple += n) composite[multiple] = true;
      if (n % 4 == 3) largest = n;
    }
    EXPECT_EQ(largest_shuffle_prime(n), largest) << n;
  }
}

TEST(ShufflePrime, IsFoundForTheLargestClouds) {
  EXPECT_EQ(largest_shuffle_prime(4'294'967'295u), 4'294'967'291u);
  EXPECT_EQ(largest_shuffle_prime(2'147'483'647u), 2'147'483'647u);  // 2^31 - 1
}

TEST(ShuffledSlot, IsAPermutationForEverySizeAndSeed) {
  for (std::uint32_t n = 1; n <= 300; ++n)
    for (const std::uint64_t seed : kSeeds) {
      std::vector<std::uint32_t> slots(n);
      for (std::uint32_t i = 0; i < n; ++i) slots[i] = shuffled_slot(i, n, seed);
      EXPECT_TRUE(is_permutation_of_indices(slots)) << n << " points, seed " << seed;
    }
}

TEST(ShuffledSlot, DependsOnTheSeed) {
  int equal = 0;
  for (std::uint32_t i = 0; i < 1'000; ++i) equal += shuffled_slot(i, 1'000, 1) == shuffled_slot(i, 1'000, 2);
  EXPECT_LT(equal, 30);
}

// Chi-square of how the points of the first `prefix` slots, which stood in a line, are spread over 50 bins.
double unevenness(std::uint32_t n, std::uint32_t prefix, std::uint64_t seed) {
  constexpr std::uint32_t kBins = 50;
  std::vector<double> counts(kBins);
  const std::uint32_t prime = largest_shuffle_prime(n);
  for (std::uint32_t i = 0; i < prime; ++i)
    if (shuffled_slot(i, n, seed) < prefix) ++counts[static_cast<std::uint64_t>(i) * kBins / prime];
  const double expected = static_cast<double>(prefix) / kBins;
  double sum = 0.0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

TEST(ShuffledSlot, AnyPrefixIsSpreadEvenlyOverTheInput) {
  // 49 degrees of freedom: 49 on average, above 95 once in 10,000 draws at random
  for (const std::uint32_t n : {20'011u, 30'000u})
    for (const std::uint32_t prefix : {n / 20, n / 5, n / 2})
      for (const std::uint64_t seed : kSeeds)
        EXPECT_LT(unevenness(n, prefix, seed), 95.0) << n << " points, prefix " << prefix << ", seed " << seed;
}

TEST(Shuffle, PutsEveryPointWhereTheCpuSays) {
  for (const std::uint32_t n :
       {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 11u, 12u, 127u, 128u, 129u, 1'019u, 4'093u, 70'001u})
    for (const std::uint64_t seed : kSeeds) {
      GpuCloud cloud = upload_shuffled(numbered_points(n), seed);
      const Slots slots = download(cloud);
      ASSERT_EQ(slots.points.size(), n);
      std::uint32_t wrong = 0;
      for (std::uint32_t i = 0; i<n; i += n> 10'000 ? 7 : 1) {
        const std::uint32_t slot = shuffled_slot(i, n, seed);
        wrong += slots.ids[slot] != i || !same(slots.points[slot], point_number(i));
      }
      EXPECT_EQ(wrong, 0u) << n << " points, seed " << seed;
    }
}

TEST(Shuffle, KeepsTheIdsThatPointsBring) {
  PointSet set = numbered_points(1'003);
  for (std::uint32_t i = 0; i < set.size(); ++i) set.ids.push_back(1'002 - i);
  GpuCloud cloud = upload_shuffled(set, 5);
  const Slots slots = download(cloud);
  EXPECT_TRUE(is_permutation_of_indices(slots.ids));
  for (std::size_t s = 0; s < slots.ids.size(); ++s)
    EXPECT_TRUE(same(slots.points[s], point_number(1'002 - slots.ids[s]))) << s;
}

TEST(Shuffle, CrossesChunksAndStagedParts) {
  constexpr std::uint32_t kCount = GpuCloud::kChunkPoints + 100'003;
  GpuCloud cloud = upload_shuffled(numbered_points(kCount), 3);
  ASSERT_EQ(cloud.chunks().size(), 2u);
  const Slots slots = download(cloud);
  std::size_t wrong = 0;
  for (std::size_t s = 0; s < kCount; ++s) wrong += !same(slots.points[s], point_number(slots.ids[s]));
  EXPECT_EQ(wrong, 0u);
  EXPECT_TRUE(is_permutation_of_indices(slots.ids));
  for (std::uint32_t i = 0; i < kCount; i += 20'011) EXPECT_EQ(slots.ids[shuffled_slot(i, kCount, 3)], i);
}

TEST(UploadInOrder, SlotIHoldsPointIAcrossChunks) {
  constexpr std::uint32_t kCount = GpuCloud::kChunkPoints + 11;
  GpuCloud cloud = upload_in_order(numbered_points(kCount));
  const Slots slots = download(cloud);
  std::size_t wrong = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) wrong += slots.ids[i] != i || !same(slots.points[i], point_number(i));
  EXPECT_EQ(wrong, 0u);
}

TEST(UploadInOrder, ItemsCoverAStretchOfSlotsOnce) {
  constexpr std::uint32_t kChunk = GpuCloud::kChunkPoints;
  const GpuCloud cloud(kChunk + 100);
  std::vector<DrawItem> items;
  cloud.append_items(kChunk - 3, 10, items);
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(std::get<PointRange>(items[0]).first, kChunk - 3);
  EXPECT_EQ(std::get<PointRange>(items[0]).count, 3u);
  EXPECT_EQ(std::get<PointRange>(items[1]).first, 0u);
  EXPECT_EQ(std::get<PointRange>(items[1]).count, 7u);
  EXPECT_NE(std::get<PointRange>(items[0]).points, std::get<PointRange>(items[1]).points);
}

// Has shaders read from a folder for as long as it lives.
class ShadersFrom {
 public:
  explicit ShadersFrom(const std::string& folder) { ::setenv("STIPPLE_SHADERS", folder.c_str(), 1); }
  ~ShadersFrom() { ::unsetenv("STIPPLE_SHADERS"); }
  ShadersFrom(const ShadersFrom&) = delete;
  ShadersFrom& operator=(const ShadersFrom&) = delete;
};

constexpr GLuint kSlotsBinding = 2 + 7;

// The functions of shuffle.glsl with a main of our own, which writes slots down instead of going there: for numbers
// that only a cloud of 64 GiB would reach.
Program slots_program(const ScratchFolder& folder) {
  for (const EmbeddedShader& shader : embedded_shaders()) {
    std::string text(shader.text);
    if (shader.name == "shuffle.glsl") {
      text.resize(text.find("void main()"));
      text += "void main() { chunk_ids[0].at[invocation_index()] = shuffled_slot(first + invocation_index()); }\n";
    }
    std::ofstream(folder.path(std::string(shader.name))) << text;
  }
  const ShadersFrom environment(folder.path(""));
  return Program::compute("shuffle.glsl", {{"CHUNKS", "7"}, {"CHUNK_POINTS", "1u"}});
}

TEST(Shuffle, ArithmeticIsExactForCloudsNearTwoToThe32) {
  constexpr std::uint32_t kCount = 12'800;
  const ScratchFolder folder;
  const Program program = slots_program(folder);
  const GpuBuffer slots(kCount * sizeof(std::uint32_t));
  for (const std::uint32_t prime : {4'294'967'291u, 2'147'483'647u, 4'294'967'279u})
    for (const std::uint32_t first : {0u, 1'073'741'000u, prime / 2 - 100, prime - kCount + 3}) {
      const std::uint32_t seed = prime - 12'345;
      program.use();
      slots.bind_storage(kSlotsBinding);
      glUniform1ui(0, first);
      glUniform1ui(2, prime);
      glUniform1ui(3, seed);
      dispatch_items(kCount, 128);
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
      std::vector<std::uint32_t> seen(kCount);
      slots.read(0, seen.data(), slots.bytes());
      // largest_shuffle_prime is slow up here, and not what is asked: only places where it gives `prime` again
      for (std::uint32_t i = 0; i < kCount; i += 997)
        EXPECT_EQ(seen[i], shuffled_slot(first + i, prime, seed)) << prime << " " << first + i;
    }
}

}  // namespace
}  // namespace stipple::test::render_shuffle
