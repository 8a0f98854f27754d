// Options that every command which draws has.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame/point_size.h"
#include "render/raster/rasterizer.h"
#include "render/store/memory_limits.h"
#include "src/run/view_run.h"

namespace stipple {

struct DrawOptions {
  std::string size = "1280x720";
  std::string raster = "compute";
  std::string budget = "1M";
  std::string fps;
  std::string steer = "cpu";
  std::string point_size = "1";
  std::string splat_size;
  std::string color;
  std::string background = "808080";
  std::uint64_t seed = 0;
  std::string carry = "vertex";
  std::string density = "box-count";
  std::string memory;
  std::string gpu_memory;
  std::vector<std::string> no_skip;
};

void add_draw_options(CLI::App& command, DrawOptions& options);
// --steer, for commands that time each frame. add_draw_options() must have been called.
void add_steer_option(CLI::App& command, DrawOptions& options);

// Their values. Each throws UsageError naming the option.
RasterizerKind rasterizer_of(const DrawOptions& options);
BudgetPolicy budget_of(const DrawOptions& options);
PointSize point_size_of(const DrawOptions& options);
MemoryLimits limits_of(const DrawOptions& options);
Skips skips_of(const DrawOptions& options);
// Seed, largest budget, limits, who steers, what hybrid may skip.
MethodOptions method_options_of(const DrawOptions& options);
// "converged", "frame:N" or "ms:T".
Until parse_until(std::string_view text);

}  // namespace stipple
