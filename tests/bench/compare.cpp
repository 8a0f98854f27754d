// What counts as moved between two benchmark runs.
#include "src/bench/compare.h"

#include <gtest/gtest.h>

#include "octree/core/error.h"

namespace stipple::test::bench_compare {
namespace {

Json document(const std::string& part, const std::vector<double>& runs) {
  return {{"size", "64x36"}, {"parts", {{{"part", part}, {"median_ms", runs[runs.size() / 2]}, {"runs_ms", runs}}}}};
}

TEST(CompareBenches, MovesOnlyWhenNoRunsOverlap) {
  const Json old = document("fill", {10, 11, 12});
  EXPECT_TRUE(compare_benches(old, document("fill", {9, 11, 13}), "old").moved.empty());
  EXPECT_TRUE(compare_benches(old, document("fill", {12, 15, 16}), "old").moved.empty());
  const BenchComparison slower = compare_benches(old, document("fill", {12.1, 22, 23}), "old");
  ASSERT_EQ(slower.moved.size(), 1);
  EXPECT_EQ(slower.moved[0].part, "fill");
  EXPECT_DOUBLE_EQ(slower.moved[0].ratio(), 2.0);
  EXPECT_EQ(compare_benches(old, document("fill", {1, 2, 9.9}), "old").moved.size(), 1);
}

TEST(CompareBenches, PartsThatOneRunLacksAreNotCompared) {
  const BenchComparison none = compare_benches(document("fill", {1}), document("prepare", {2}), "old");
  EXPECT_EQ(none.compared, 0);
  EXPECT_TRUE(none.moved.empty());
}

TEST(CompareBenches, SaysWhichSettingsDiffer) {
  Json other = document("fill", {1});
  other["size"] = "128x72";
  const BenchComparison comparison = compare_benches(document("fill", {1}), other, "old");
  ASSERT_EQ(comparison.differences.size(), 1);
  EXPECT_NE(comparison.differences[0].find("size was \"64x36\" and is \"128x72\""), std::string::npos);
}

TEST(CompareBenches, NamesTheFileThatIsNone) {
  for (const Json& old : {Json::array(), Json::object(), Json{{"parts", {{{"part", "fill"}}}}}}) {
    try {
      compare_benches(old, document("fill", {1}), "old.json");
      FAIL() << old.dump();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("old.json"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace stipple::test::bench_compare
