#include "render/measure/npy.h"

#include <limits>
#include <numeric>

#include "tests/measure/npy_reader.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::measure_npy {
namespace {

TEST(Npy, DataBeginAtAMultipleOf64AfterAHeaderThatEndsInANewline) {
  const ScratchFolder folder;
  std::vector<std::size_t> shape;
  // Longer and longer shapes take the header across the boundary
  for (int dimensions = 0; dimensions < 40; ++dimensions) {
    write_npy(folder.path("a.npy"), std::span<const float>(), shape);
    const NpyFile file = read_npy(folder.path("a.npy"));
    EXPECT_EQ(file.data_begin % 64, 0u) << dimensions;
    EXPECT_EQ(file.bytes.size(), file.data_begin) << dimensions;
    EXPECT_EQ(file.header.back(), '\n');
    EXPECT_LT(file.data_begin, 10 + file.header.find('}') + 66) << "more padding than needed";
    shape.insert(shape.begin(), dimensions % 2 ? 0 : 12);
  }
}

TEST(Npy, HeaderNamesTypeOrderAndShape) {
  const ScratchFolder folder;
  write_npy(folder.path("f.npy"), std::vector<float>(6), {2, 3});
  EXPECT_TRUE(read_npy(folder.path("f.npy"))
                  .header.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3,), }"));
  write_npy(folder.path("d.npy"), std::vector<double>(5), {5});
  EXPECT_TRUE(
      read_npy(folder.path("d.npy")).header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (5,), }"));
}

TEST(Npy, ValuesComeBackBitByBit) {
  const ScratchFolder folder;
  std::vector<float> floats(1'000);
  std::iota(floats.begin(), floats.end(), -3.25f);
  floats[7] = std::numeric_limits<float>::infinity();
  write_npy(folder.path("f.npy"), floats, {10, 100});
  EXPECT_EQ(read_npy(folder.path("f.npy")).values<float>(), floats);

  const std::vector<double> doubles{5'300'000.123456789, -0.0, 1e-300, std::numeric_limits<double>::quiet_NaN()};
  write_npy(folder.path("d.npy"), doubles, {2, 2});
  const std::vector<double> back = read_npy(folder.path("d.npy")).values<double>();
  ASSERT_EQ(back.size(), doubles.size());
  EXPECT_EQ(std::memcmp(back.data(), doubles.data(), 8 * doubles.size()), 0);
}

TEST(Npy, AFolderThatIsMissingIsNamedAndNothingIsLeft) {
  const ScratchFolder folder;
  const std::string path = folder.path("missing/a.npy");
  EXPECT_TRUE(contains(error_of([&] { write_npy(path, std::vector<float>(1), {1}); }), path));
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace stipple::test::measure_npy
