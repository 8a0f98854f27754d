// Generated test scenes, by name.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

constexpr std::uint64_t kMaxScenePoints = 10'000'000'000ull;

// "city", "terrain", ... in the order in which a help text lists them.
std::vector<std::string> scene_names();

// One sentence on the scene called `name`. Throws UsageError as make_scene does.
std::string describe_scene(std::string_view name);

// A scene with exactly `points` points. Every point depends on name, points, seed and its index alone, so that the
// cloud has the same bits on any number of cores. Throws UsageError for a name that is not among scene_names() or more
// than kMaxScenePoints.
std::unique_ptr<PointSource> make_scene(const std::string& name, std::uint64_t points, std::uint64_t seed);

}  // namespace stipple
