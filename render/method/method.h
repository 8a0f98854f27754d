// A method decides which points a frame draws beside those it carries over from the last one; nothing else is its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/frame/camera.h"
#include "render/raster/rasterizer.h"
#include "render/store/dataset.h"

namespace stipple {

// How the last frame gets into the next.
enum class Carry {
  none,      // not at all: each frame starts from nothing
  grid,      // T16: a screen-filling grid of points reads the last target
  vertices,  // S19: a prepare pass collects the visible points in a vertex buffer
};

// What to draw in a frame.
struct Selection {
  std::vector<DrawItem> items;
  std::uint64_t points = 0;
};

// Sums since the method was made, but for nodes_visible, which is the current view's.
struct SelectionCounts {
  std::uint64_t nodes_visible = 0;
  std::uint64_t bytes_read = 0;  // from disk, the opening of the tree included, or streamed from main memory to the GPU
};

class Method {
 public:
  virtual ~Method() = default;

  virtual Carry carry() const = 0;
  // The view changed: every point may be worth drawing again.
  virtual void start_view(const View& view) = 0;
  // The next points for this view, at most `budget`. Valid until the next call.
  virtual Selection select(std::uint32_t budget) = 0;
  // Nothing is left for this view: the picture equals the brute-force picture.
  virtual bool finished() const = 0;
  virtual SelectionCounts counts() const { return {}; }
};

enum class Mode { brute_force, hierarchical, unstructured };

std::span<const Mode> all_modes();
// "brute-force", "hierarchical", "unstructured".
std::string_view name_of(Mode mode);
std::optional<Mode> mode_named(std::string_view name);
// Whether the mode draws from an octree, in memory or on disk; then it needs no points in memory if that is on disk.
bool needs_octree(Mode mode);

struct MethodOptions {
  std::uint64_t seed = 0;                  // of the shuffle
  std::uint32_t largest_budget = 1 << 20;  // points select() may be asked for; limits may allow fewer
  MemoryLimits limits{};
};

// Points (and the tree, where the mode needs one: points then stand in its store order) must outlive the method.
// Uploads what the mode keeps on the GPU. Throws Error when memory is refused, by limits.gpu or the driver.
std::unique_ptr<Method> make_method(Mode mode, const PointSet& points, const Octree* octree,
                                    const MethodOptions& options = {});
// The same for a dataset, whose tree may be on disk.
std::unique_ptr<Method> make_method(Mode mode, const Dataset& dataset, const MethodOptions& options = {});

}  // namespace stipple
