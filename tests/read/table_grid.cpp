// The grid under floating point coordinates: exact where it says so, and close where it says how close.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>

#include "octree/read/table/position_scan.h"
#include "tests/read/read_fixture.h"

namespace stipple::test::read_table_grid {
namespace {

ChosenGrid grid_of(const std::vector<double>& x, bool single = false) {
  std::array<AxisScan, 3> axes;
  for (AxisScan& axis : axes) axis.add(x, single);
  return choose_grid(axes);
}

TEST(TableGrid, PowersOfTwoAreExact) {
  for (const double step : {1.0, 0x1p-5, 0x1p-20}) {
    std::vector<double> values;
    for (int i = 0; i < 1'000; ++i) values.push_back(step * (i * 7'919 % 100'003));
    const ChosenGrid chosen = grid_of(values);
    EXPECT_EQ(chosen.largest_rounding, 0.0);
    int exponent = 0;
    EXPECT_EQ(std::frexp(chosen.grid.scale.x, &exponent), 0.5);
    EXPECT_EQ(std::fmod(step, chosen.grid.scale.x), 0.0);
  }
}

TEST(TableGrid, DecimalNumbersAreExactWhetherFloatOrDouble) {
  std::mt19937 random(1);
  for (const bool single : {false, true})
    for (const double unit : {1e2, 1e3, 1e6}) {
      std::vector<double> values;
      for (int i = 0; i < 1'000; ++i) {
        const double value = static_cast<double>(random() % 1'000'000) / unit;
        values.push_back(single ? static_cast<double>(static_cast<float>(value)) : value);
      }
      const ChosenGrid chosen = grid_of(values, single);
      EXPECT_EQ(chosen.largest_rounding, 0.0);
      // Floats may as well be on a power of two
      if (!single) {
        EXPECT_NEAR(std::log10(chosen.grid.scale.x), std::round(std::log10(chosen.grid.scale.x)), 1e-12);
      }
    }
}

TEST(TableGrid, LargeOffsetsDoNotCostPrecision) {
  std::vector<double> values;
  for (int i = 0; i < 1'000; ++i) values.push_back(4'320'978.0 + 0.001 * i);
  EXPECT_EQ(grid_of(values).largest_rounding, 0.0);
  for (double& value : values) value = std::ldexp(1.0, 40) + std::round(value * 256.0) / 256.0;
  const ChosenGrid chosen = grid_of(values);
  EXPECT_EQ(chosen.largest_rounding, 0.0);
  EXPECT_GT(chosen.grid.offset.x, std::ldexp(1.0, 39));
}

TEST(TableGrid, WhatFitsNoGridIsOnTheFinestThatHoldsItsRange) {
  const ChosenGrid chosen = grid_of({-1.0, 1.0 / 3.0, 1e-9 / 3.0, 1.0});
  EXPECT_GT(chosen.largest_rounding, 0.0);
  EXPECT_LT(chosen.largest_rounding, 2.0 / 4e9);
}

TEST(TableGrid, ExtremesStayNumbers) {
  for (const std::vector<double>& values :
       {std::vector{-1e100, 1e100}, std::vector{0.0, 5e-324}, std::vector{1e-310, 3e-310}, std::vector{0.0},
        std::vector<double>{}, std::vector{1e100, std::nextafter(1e100, 0.0)}, std::vector{0.1, 1e99}}) {
    const ChosenGrid chosen = grid_of(values);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(std::isfinite(chosen.grid.scale[axis]) && chosen.grid.scale[axis] > 0.0);
      EXPECT_TRUE(std::isfinite(chosen.grid.offset[axis]));
      for (const double value : values) {
        const double at = chosen.grid.grid_from_world(glm::dvec3(value))[axis];
        EXPECT_LE(std::abs(at), 2147483648.0) << value;
      }
    }
  }
}

TEST(TableGrid, TheStepIsFarBelowTheCloud) {
  EXPECT_LE(grid_of({-1.0, 1.0}).grid.scale.x, 1e-3);
  EXPECT_LE(grid_of({0.0, 1e6}).grid.scale.x, 250.0);
}

// A file of random points of one kind; `expected` gets the coordinates as the file has them.
std::string random_file(std::mt19937_64& random, std::vector<glm::dvec3>& expected, bool& single) {
  const ScalarType types[] = {ScalarType::f32, ScalarType::f64, ScalarType::i32, ScalarType::i16, ScalarType::u8};
  const char* const names[] = {"float", "double", "int", "short", "uchar"};
  const char* const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::size_t type = random() % 5, format = random() % 3, count = random() % 3'000;
  single = types[type] == ScalarType::f32 && format != 0;
  const int kind = static_cast<int>(random() % 4);
  const double center = std::ldexp(static_cast<double>(random() % 1'000), static_cast<int>(random() % 16));
  const auto coordinate = [&]() -> double {
    const auto part = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
    if (types[type] == ScalarType::u8) return static_cast<double>(random() % 256);
    if (types[type] == ScalarType::i16) return std::round(part * 60'000);
    if (types[type] == ScalarType::i32) return std::round(part * 4e9);
    const double value = kind == 0   ? center + part
                         : kind == 1 ? std::round((center + part * 100) * 1000) / 1000
                         : kind == 2 ? std::round((center + part) * 1024) / 1024
                                     : part * std::pow(10.0, static_cast<double>(random() % 40) - 20.0);
    return types[type] == ScalarType::f32 ? static_cast<double>(static_cast<float>(value)) : value;
  };
  std::string file = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", formats[format], count);
  for (const char axis : {'x', 'y', 'z'}) file += fmt::format("property {} {}\n", names[type], axis);
  file += "end_header\n";
  Binary body(format == 2);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 p(coordinate(), coordinate(), coordinate());
    expected.push_back(p);
    if (format == 0)
      file += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    else
      for (int axis = 0; axis < 3; ++axis) body.put_as(types[type], p[axis]);
  }
  return file + body.bytes();
}

class TableRoundTrip : public TableFiles {};

TEST_F(TableRoundTrip, RandomPointsOfAnyTypeComeBackAsNearAsTheSourceSays) {
  std::mt19937_64 random(20'251'122);
  int exact = 0, rounded = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    std::vector<glm::dvec3> expected;
    bool single = false;
    const Cloud cloud = load(random_file(random, expected, single));
    ASSERT_EQ(cloud.size(), expected.size());
    const bool says = !cloud.info.warnings.empty();
    (says ? rounded : exact) += 1;
    const auto read = worlds(cloud);
    for (std::size_t i = 0; i < read.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double from = expected[i][axis], to = read[i][axis];
        // offset + scale * position rounds twice
        const double ulps = 4 * 0x1p-53 * std::max({std::abs(from), std::abs(cloud.info.grid.offset[axis])});
        if (says)
          ASSERT_NEAR(from, to, cloud.info.grid.scale[axis] * 0.5000001 + ulps);
        else if (single)
          ASSERT_EQ(static_cast<float>(from), static_cast<float>(to));
        else
          ASSERT_NEAR(from, to, ulps);
      }
  }
  // Both happen
  EXPECT_GT(exact, 100);
  EXPECT_GT(rounded, 20);
}

TEST_F(TableRoundTrip, TheSameFileGivesTheSameCloudEveryTime) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 20; ++round) {
    std::vector<glm::dvec3> expected;
    bool single = false;
    const std::string content = random_file(random, expected, single);
    const Cloud first = load(content), second = load(content);
    EXPECT_EQ(first.info.grid.scale, second.info.grid.scale);
    EXPECT_EQ(first.info.grid.offset, second.info.grid.offset);
    EXPECT_EQ(first.positions, second.positions);
  }
}

}  // namespace
}  // namespace stipple::test::read_table_grid
