#include "octree/select/density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <unordered_set>

#include "octree/build/builder.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_density_test {
namespace {

using Shape = std::function<glm::dvec3(std::mt19937&)>;  // a random point within 1 of the origin

double unit(std::mt19937& random) {
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

glm::dvec3 random_direction(std::mt19937& random) {
  while (true) {
    const glm::dvec3 v(unit(random), unit(random), unit(random));
    if (glm::length(v) > 0.1 && glm::length(v) < 1.0) return glm::normalize(v);
  }
}

// Random points of a shape, in an octree of one node, whose profile is that of the whole set. They stand anywhere in a
// larger root cube, as those of a cluster do.
struct Sample {
  Sample(const Shape& shape, std::size_t count, std::mt19937& random) {
    for (std::size_t i = 0; i < count; ++i) positions.push_back(glm::ivec3(shape(random) * 1e6));
    const glm::ivec3 place(glm::dvec3(unit(random), unit(random), unit(random)) * 2e6);
    const GridBox bounds{place - 5'000'000, place + 5'000'000};
    octree = build_octree({glm::dvec3(0.0), glm::dvec3(1e-6)}, bounds, positions, {.leaf_capacity = count});
  }

  double estimate(double pixel_size) const {
    return estimated_pixels(octree.nodes[0].profile, octree.cube.edge, pixel_size);
  }

  // Pixels that the points hit, seen from far away along `direction`: the mean over places of the pixel grid, on which
  // it depends by up to a factor of 4 for a set smaller than a pixel.
  double rasterised(double pixel_size, const glm::dvec3& direction, std::mt19937& random) const {
    constexpr int kPlaces = 4;
    const glm::dvec3 right = glm::normalize(glm::cross(direction, random_direction(random)));
    const glm::dvec3 up = glm::cross(right, direction);
    std::unordered_set<std::int64_t> pixels;
    for (int place = 0; place < kPlaces; ++place) {
      const double shift_x = unit(random), shift_y = unit(random);
      for (const glm::ivec3& position : positions) {
        const glm::dvec3 p = octree.grid.world_from_grid(position) / pixel_size;
        const auto x = static_cast<std::int64_t>(std::floor(glm::dot(right, p) + shift_x));
        const auto y = static_cast<std::int64_t>(std::floor(glm::dot(up, p) + shift_y));
        pixels.insert((x * 1'000'000 + y) * kPlaces + place);
      }
    }
    return static_cast<double>(pixels.size()) / kPlaces;
  }

  std::vector<glm::ivec3> positions;
  Octree octree;
};

Shape line(const glm::dvec3& along) {
  return [along](std::mt19937& random) { return along * unit(random); };
}

Shape patch(const glm::dvec3& normal) {
  const glm::dvec3 a = glm::normalize(glm::cross(normal, glm::dvec3(0.36, 0.48, 0.8)));
  const glm::dvec3 b = glm::cross(normal, a);
  return [a, b](std::mt19937& random) { return 0.7 * (a * unit(random) + b * unit(random)); };
}

glm::dvec3 volume(std::mt19937& random) {
  return 0.5 * glm::dvec3(unit(random), unit(random), unit(random));
}

// Two dense heaps at opposite corners of a box that is otherwise empty.
glm::dvec3 heaps(std::mt19937& random) {
  const double corner = unit(random) < 0.0 ? -0.5 : 0.5;
  return glm::dvec3(corner) + 0.01 * glm::dvec3(unit(random), unit(random), unit(random));
}

// How far the estimate is off, as a factor of 1 or more: the worst over sizes of pixels and directions of view.
double worst_factor(const Shape& shape, std::size_t count, unsigned seed,
                    const std::function<bool(const glm::dvec3&)>& looks_from) {
  std::mt19937 random(seed);
  const Sample sample(shape, count, random);
  double worst = 1.0;
  for (double pixel_size = 2.0; pixel_size > 1e-4; pixel_size /= 3.0) {
    glm::dvec3 direction = random_direction(random);
    while (!looks_from(direction)) direction = random_direction(random);
    const double ratio = sample.estimate(pixel_size) / sample.rasterised(pixel_size, direction, random);
    worst = std::max({worst, ratio, 1.0 / ratio});
  }
  return worst;
}

constexpr double kFactor = 3.0;
constexpr double kVolumeFactor = 6.0;
constexpr std::size_t kPoints = 50'000;

TEST(EstimatedPixels, OfARandomPatchAreWithinAFactorOfThoseRasterised) {
  std::mt19937 random(1);
  for (unsigned seed = 0; seed < 6; ++seed) {
    const glm::dvec3 normal = random_direction(random);
    // A profile knows no direction: seen edge-on, a patch is a line.
    const auto not_edge_on = [&](const glm::dvec3& direction) { return std::abs(glm::dot(direction, normal)) > 0.5; };
    EXPECT_LT(worst_factor(patch(normal), kPoints, seed, not_edge_on), kFactor);
  }
}

TEST(EstimatedPixels, OfARandomLineAreWithinAFactorOfThoseRasterised) {
  std::mt19937 random(2);
  for (unsigned seed = 0; seed < 6; ++seed) {
    const glm::dvec3 along = random_direction(random);
    const auto not_end_on = [&](const glm::dvec3& direction) { return std::abs(glm::dot(direction, along)) < 0.8; };
    EXPECT_LT(worst_factor(line(along), kPoints, seed, not_end_on), kFactor);
  }
}

TEST(EstimatedPixels, OfAVolumeAreWithinAFactorOfThoseRasterised) {
  for (unsigned seed = 0; seed < 6; ++seed)
    EXPECT_LT(worst_factor(volume, kPoints, seed, [](const glm::dvec3&) { return true; }), kVolumeFactor);
}

TEST(EstimatedPixels, NeverFallWhenPixelsShrinkAndNeverExceedTheNumberOfPoints) {
  std::mt19937 random(3);
  for (const Shape& shape : {Shape(volume), Shape(heaps), patch({0.6, 0.0, 0.8}), line({0, 1, 0})}) {
    const Sample sample(shape, kPoints, random);
    double before = 0.0;
    for (double pixel_size = 10.0; pixel_size > 1e-9; pixel_size *= 0.93) {
      const double pixels = sample.estimate(pixel_size);
      ASSERT_GE(pixels, before * (1.0 - 1e-12));
      ASSERT_LE(pixels, static_cast<double>(kPoints) * (1.0 + 1e-12));
      before = pixels;
    }
  }
}

TEST(EstimatedPixels, AreOneForPixelsLargerThanTheCubeAndNoneForNoPoints) {
  std::mt19937 random(4);
  EXPECT_EQ(Sample(volume, 1'000, random).estimate(20.0), 1.0);
  EXPECT_EQ(estimated_pixels(BoxCounts{}, 1.0, 0.1), 0.0);
}

TEST(UniformPixels, AreTheOutlineOfTheBoxInPixelsButNoMoreThanThePoints) {
  const WorldBox box{{0, 0, 0}, {2, 3, 4}};
  EXPECT_DOUBLE_EQ(uniform_pixels(box, 1'000'000, {0, 0, 1}, 0.1), 600.0);
  EXPECT_DOUBLE_EQ(uniform_pixels(box, 1'000'000, {-1, 0, 0}, 0.1), 1200.0);
  EXPECT_DOUBLE_EQ(uniform_pixels(box, 50, {0, 0, 1}, 0.1), 50.0);
  EXPECT_DOUBLE_EQ(uniform_pixels(box, 50, {0, 0, 1}, 100.0), 1.0);
}

TEST(UniformPixels, OfAClusteredSetAreFartherOffThanThoseOfItsProfile) {
  std::mt19937 random(5);
  const Sample sample(heaps, kPoints, random);
  const WorldBox box = world_box(sample.octree.grid, sample.octree.nodes[0].box);
  double profile_error = 0.0, uniform_error = 0.0;
  for (double pixel_size = 0.1; pixel_size > 1e-3; pixel_size /= 2.0) {
    const glm::dvec3 direction = random_direction(random);
    const double pixels = sample.rasterised(pixel_size, direction, random);
    const double uniform = uniform_pixels(box, kPoints, direction, pixel_size);
    profile_error = std::max(profile_error, std::abs(std::log(sample.estimate(pixel_size) / pixels)));
    uniform_error = std::max(uniform_error, std::abs(std::log(uniform / pixels)));
  }
  EXPECT_LT(profile_error, std::log(kVolumeFactor));
  EXPECT_GT(uniform_error, std::log(30.0));
}

}  // namespace
}  // namespace stipple::test::octree_density_test
