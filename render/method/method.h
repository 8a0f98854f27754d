// A method decides which points a frame draws beside those it carries over from the last one; nothing else is its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/select/density.h"
#include "render/frame/budget.h"
#include "render/frame/camera.h"
#include "render/frame/point_size.h"
#include "render/method/sighted_box.h"
#include "render/method/skips.h"
#include "render/raster/rasterizer.h"
#include "render/store/cluster_cut.h"
#include "render/store/color_upload.h"
#include "render/store/dataset.h"
#include "render/store/unread.h"

namespace stipple {

// How the last frame gets into the next.
enum class Carry {
  none,  // not at all: each frame starts from nothing
  grid,  // T16: a screen-filling grid of points reads the last target; as vertices where points cover several pixels
  vertices,  // S19: a prepare pass collects the visible points in a vertex buffer
  indices,   // S18: as their places in buffers that the method has; it draws them itself
};

// What to draw in a frame.
struct Selection {
  std::vector<DrawItem> items;
  std::uint64_t points = 0;
};

// Sums since the method was made, but for the nodes, which are the current view's.
struct SelectionCounts {
  std::uint64_t nodes_visible{};  // hybrid: clusters
  // Of those, not drawn further because all they have left is hidden; hybrid: clusters.
  std::uint64_t nodes_occluded{};
  // With splats: of the clusters in sight of hierarchical and lod, those whose points are all squares, all splats, or
  // may be both.
  std::uint64_t clusters_far{};
  std::uint64_t clusters_near{};
  std::uint64_t clusters_across{};
  double pixels_estimated{};    // hierarchical: that the clusters in sight can cover, by its estimate of their density
  std::uint64_t bytes_read{};   // from disk, the opening of the tree included, or streamed from main memory to the GPU
  std::uint64_t points_read{};  // hybrid, of a tree on disk
};

// Counts a cluster among those.
void count_splats(SplatRange range, SelectionCounts& counts);

class SteeredRound;

class Method {
 public:
  virtual ~Method() = default;

  virtual Carry carry() const = 0;
  // Whether a frame of a still view goes on from the last one as it stands, instead of carrying it into an empty one.
  virtual bool keeps_still_view() const { return false; }
  // Whether a still view is drawn on when it has finished.
  virtual bool draws_on() const { return false; }
  // Nothing is carried into the next frame: it starts from an empty target, as the first did.
  virtual void forget() {}
  // How large points are drawn from the next view on.
  virtual void set_point_size(const PointSize&) {}
  // The view, of one eye or two, changed: every point may be worth drawing again. What follows chooses for both eyes.
  virtual void start_view(const View& view) = 0;
  // Has each pass of its own run once, on the finished `frame` of each eye of `view`, so that the driver's compiling
  // stays outside of timed parts; the block of the first eye is bound. forget() follows.
  virtual void warm_up(const View&, const FeedbackTarget&) {}
  // Carry::indices: the items that draw what this finished frame, the last of an eye, shows. Valid until the next call.
  virtual void append_carried(const FeedbackTarget&, std::vector<DrawItem>&) {}
  // Whether select() wants to know what the picture shows: then what is carried into a new view is drawn first.
  virtual bool selects_by_picture() const { return false; }
  // What select() adds to, the frame of this eye, where there is anything in it; the eye's block is bound.
  virtual void see(const FeedbackTarget&, std::size_t /*eye*/) {}
  // The next points for this view, at most `budget`, for each of its eyes. Valid until the next call. The block of the
  // first eye is bound.
  virtual Selection select(std::uint32_t budget) = 0;
  // Where the GPU decides how many points a frame draws (MethodOptions::steering), this does it. Then select()'s budget
  // is the most, and what is selected and whether the method has finished are known as late as the GPU tells.
  virtual SteeredRound* steered() { return nullptr; }
  // The frame of this eye with the selected points is drawn; the eye's block is bound.
  virtual void frame_drawn(const FeedbackTarget&, std::size_t /*eye*/) {}
  // Nothing is left for this view: the picture equals the brute-force picture, but for what is unread() and for mode
  // lod, which stops at the budget.
  virtual bool finished() const = 0;
  virtual SelectionCounts counts() const { return {}; }
  // What was left out of this view; null where the method does not count it. May wait for the GPU.
  virtual std::optional<SkipCounts> skipped() const { return std::nullopt; }
  // Of a tree on disk, what this view needs and could not be read: the picture does without. The next view asks again.
  virtual Unread unread() const { return {}; }
  // The points on the GPU that it draws from, all of them: new colours may be painted on them (ColorUpload). Nothing:
  // what it draws comes from elsewhere.
  virtual std::optional<std::vector<ColoredPoints>> colored() const { return std::nullopt; }
  // Its points have these colours from now on: painted where they lie on the GPU; where it has them from main memory,
  // `points`, the same ones in the same order, take their place and must outlive it. False where neither is so: they
  // come from disk, in the colours that it was made with.
  virtual bool recolor(const ColorUpload& colors, const PointSet& points);
  // Those in sight; none where the method knows none. May wait for the GPU.
  virtual std::vector<SightedBox> boxes() const { return {}; }
};

enum class Mode { brute_force, hierarchical, unstructured, hybrid, lod, subsample };

std::span<const Mode> all_modes();
// "brute-force", "hierarchical", "unstructured", "hybrid", "lod", "subsample".
std::string_view name_of(Mode mode);
std::optional<Mode> mode_named(std::string_view name);
// All of them, separated by commas.
std::string mode_names();
// What the mode draws from: all points in memory, or an octree, which may stay on disk.
DatasetNeeds needs_of(Mode mode, const Skips& skips = {});

// The GPU steers the points a frame, as BudgetController does, to this time by its own clock.
struct GpuSteering {
  double target_ms = 0.0;
  std::uint32_t first_budget = BudgetController::kFirstBudget;
  BudgetController::Limits limits{};
};

struct MethodOptions {
  std::uint64_t seed = 0;                  // of the shuffle
  std::uint32_t largest_budget = 1 << 20;  // points select() may be asked for; limits may allow fewer
  MemoryLimits limits{};
  Skips skips{};                                         // hybrid
  bool carry_indices = false;                            // unstructured: as S18, not as S19
  DensityEstimate density = DensityEstimate::box_count;  // hierarchical: how many points are worth a round
  std::optional<GpuSteering> steering{};                 // unstructured: without it select() has the budget
};

// Points (and the tree, where the mode needs one: points then stand in its store order) must outlive the method.
// Uploads what the mode keeps on the GPU. Throws Error when memory is refused, by limits.gpu or the driver.
std::unique_ptr<Method> make_method(Mode mode, const PointSet& points, const Octree* octree,
                                    const MethodOptions& options = {});
// The same for a dataset, whose tree may be on disk.
std::unique_ptr<Method> make_method(Mode mode, const Dataset& dataset, const MethodOptions& options = {});
// Mode hybrid for points that are cut already, by cut_cloud().
std::unique_ptr<Method> make_hybrid(const PointSet& points, const ClusterCut& cut, const MethodOptions& options);

}  // namespace stipple
