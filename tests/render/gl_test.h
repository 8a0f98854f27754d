// What all tests with an OpenGL context share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "octree/cloud/source.h"
#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/method/method.h"
#include "render/store/dataset.h"

namespace stipple::test {

// A scene as a dataset with an octree, made once for all tests.
const Dataset& scene(const std::string& name, std::uint64_t points);

// The first of the proposed cameras ("oblique", "aerial", "low") with this name.
View view_of(const Dataset& dataset, const std::string& camera, const glm::ivec2& size = {320, 180});

// Points on the grid of millimetres around the origin, with ids 0, 1, ...
PointSet points_at(const std::vector<glm::ivec3>& positions);
// Pseudo-random points in a box of `extent` cells around the origin; every tenth is a copy of an earlier one with
// another colour.
PointSet random_points(std::size_t count, int extent, std::uint32_t seed);
// Looks along +y at the origin from `distance` world units away.
View front_view(double distance, const glm::ivec2& size = {320, 180});

// Equal ids, colours, positions and depths in every pixel. A failure names the first differing pixels and draws a map
// of where they are.
testing::AssertionResult same_picture(const FrameData& a, const FrameData& b);

// Draws one frame of everything.
FrameData brute_force_picture(const PointSet& points, RasterizerKind rasterizer, const View& view,
                              const PointSize& point_size = {});
// Draws frames of `budget` points until converged. Fails after a million frames.
FrameData converged_picture(Method& method, RasterizerKind rasterizer, const Grid& grid, const View& view,
                            std::uint32_t budget, const PointSize& point_size = {});

}  // namespace stipple::test
