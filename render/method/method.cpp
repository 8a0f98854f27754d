#include "render/method/method.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "octree/core/error.h"
#include "render/method/brute_force.h"
#include "render/method/hierarchical.h"
#include "render/method/hybrid.h"
#include "render/method/lod.h"
#include "render/method/subsample.h"
#include "render/method/tree_clusters.h"
#include "render/method/unstructured.h"
#include "render/store/cluster_cloud.h"
#include "render/store/memory_supply.h"
#include "render/store/tree_supply.h"

namespace stipple {
namespace {

constexpr std::array kModes{Mode::brute_force, Mode::hierarchical, Mode::unstructured,
                            Mode::hybrid,      Mode::lod,          Mode::subsample};

// Of modes that keep all points on the GPU.
void check_room(Mode mode, std::size_t points, std::uint64_t bytes, const MemoryLimits& limits) {
  if (bytes <= limits.gpu) return;
  throw Error(
      fmt::format("mode {} keeps all {} points on the GPU, {} bytes, and {} are allowed. Allow more with "
                  "--gpu-memory, or draw in mode hierarchical.",
                  name_of(mode), points, bytes, limits.gpu));
}

ClusterSelector::Options selector_options(const MethodOptions& options, std::uint32_t budget) {
  return {.largest_budget = budget, .skips = options.skips};
}

// Throws Error where there is too little memory for mode hybrid; else gives the budget that it is made for.
std::uint32_t check_hybrid(const PointSet& points, const MethodOptions& options) {
  const std::uint64_t sorting = points.size() * kBytesPerPointOfOctree;
  if (sorting > options.limits.main)
    throw Error(
        fmt::format("mode hybrid takes about {} bytes of memory to sort {} points, and {} are allowed. Allow more with "
                    "--memory, or draw in mode hierarchical.",
                    sorting, points.size(), options.limits.main));
  const auto budget = static_cast<std::uint32_t>(std::clamp<std::size_t>(points.size(), 1, options.largest_budget));
  check_room(Mode::hybrid, points.size(),
             cluster_bytes_for(points.size()) + ClusterSelector::bytes_for(clusters_for(points.size()), budget),
             options.limits);
  return budget;
}

std::unique_ptr<Method> make_hybrid(const PointSet& points, const MethodOptions& options) {
  const std::uint32_t budget = check_hybrid(points, options);
  return std::make_unique<Hybrid>(std::make_unique<WholeCloud>(upload_clusters(points)),
                                  selector_options(options, budget));
}

// GPU memory for the pool of a tree on disk, where no limit is given: 47 million points.
constexpr std::uint64_t kPoolBytes = std::uint64_t{1} << 30;

std::unique_ptr<Method> make_hybrid(const Dataset& dataset, const MethodOptions& options) {
  const std::uint64_t points = dataset.tree->info().states_points ? std::max<std::uint64_t>(dataset.info.point_count, 1)
                                                                  : std::uint64_t{1} << 40;
  const auto budget = static_cast<std::uint32_t>(std::min<std::uint64_t>(points, options.largest_budget));
  const std::uint64_t slot_bytes = ClusterPool::kSlotBytes + ClusterSelector::bytes_for(1, 0);
  const std::uint64_t gpu = options.limits.gpu == MemoryLimits::kNone ? kPoolBytes : options.limits.gpu;
  const std::uint64_t for_slots = gpu - std::min(gpu, ClusterSelector::bytes_for(0, budget));
  // Parts fill their last slot in part only
  const std::uint64_t useful = points / SlottedPoints::kPoints * 3 / 2 + 1024;
  const std::uint64_t slots =
      std::min<std::uint64_t>({for_slots / slot_bytes, useful, std::uint64_t{ClusterTable::kMostClusters}});
  if (slots == 0)
    throw Error(
        fmt::format("mode hybrid takes {} bytes of GPU memory at least, and {} are allowed. Allow more with "
                    "--gpu-memory.",
                    gpu - for_slots + slot_bytes, gpu));
  return std::make_unique<Hybrid>(
      std::make_unique<TreeClusters>(dataset.tree, dataset.colors, dataset.bytes_to_load,
                                     TreeClusters::Options{.slots = static_cast<std::uint32_t>(slots),
                                                           .points_ahead = options.limits.main / kBytesPerStreamedPoint,
                                                           .all_attributes = !options.skips.attributes}),
      selector_options(options, budget));
}

// The pool has room for twice what a frame draws: what comes while the camera moves finds what goes.
std::unique_ptr<Method> make_lod(const Dataset& dataset, const MethodOptions& options) {
  constexpr std::uint64_t kPointsOfPart = 2'000;  // and its last slot, half full
  const std::uint64_t points = 2 * std::uint64_t{options.largest_budget};
  const std::uint64_t wanted = points / SlottedPoints::kPoints + points / kPointsOfPart + 1024;
  const std::uint64_t slots = std::min<std::uint64_t>(
      {wanted, options.limits.gpu / ClusterPool::kSlotBytes, std::uint64_t{ClusterTable::kMostClusters}});
  return std::make_unique<Lod>(std::make_unique<TreeLod>(dataset.tree, dataset.colors, dataset.bytes_to_load,
                                                         static_cast<std::uint32_t>(slots)));
}

}  // namespace

bool Method::recolor(const ColorUpload& colors, const PointSet&) {
  const auto mine = colored();
  if (!mine) return false;
  for (const ColoredPoints& points : *mine) colors.paint(points);
  return true;
}

void count_splats(SplatRange range, SelectionCounts& counts) {
  ++(range == SplatRange::far    ? counts.clusters_far
     : range == SplatRange::near ? counts.clusters_near
                                 : counts.clusters_across);
}

std::span<const Mode> all_modes() {
  return kModes;
}

std::string_view name_of(Mode mode) {
  switch (mode) {
    case Mode::brute_force:
      return "brute-force";
    case Mode::hierarchical:
      return "hierarchical";
    case Mode::unstructured:
      return "unstructured";
    case Mode::hybrid:
      return "hybrid";
    case Mode::lod:
      return "lod";
    case Mode::subsample:
      return "subsample";
  }
  return "";
}

std::optional<Mode> mode_named(std::string_view name) {
  for (const Mode mode : kModes)
    if (name_of(mode) == name) return mode;
  return std::nullopt;
}

std::string mode_names() {
  std::string names;
  for (const Mode mode : kModes) names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(mode));
  return names;
}

DatasetNeeds needs_of(Mode mode, const Skips& skips) {
  const bool nodes = mode == Mode::hierarchical || mode == Mode::lod;
  const bool hybrid = mode == Mode::hybrid;
  return {.points = hybrid ? !skips.nodes : !nodes, .octree = nodes, .all_attributes = hybrid && !skips.attributes};
}

std::unique_ptr<Method> make_method(Mode mode, const PointSet& points, const Octree* octree,
                                    const MethodOptions& options) {
  switch (mode) {
    case Mode::brute_force:
      check_room(mode, points.size(), points.size() * kGpuBytesPerPoint, options.limits);
      return std::make_unique<BruteForce>(points);
    case Mode::hierarchical:
      if (!octree) throw Error("mode hierarchical needs an octree");
      // A section for more points than there are would stay empty
      return std::make_unique<Hierarchical>(std::make_unique<MemorySupply>(points, *octree, options.density),
                                            std::min(budget_within({.gpu = options.limits.gpu}, options.largest_budget),
                                                     static_cast<std::uint32_t>(points.size())));
    case Mode::unstructured:
      check_room(mode, points.size(), points.size() * kGpuBytesPerPoint, options.limits);
      return std::make_unique<Unstructured>(points, options.seed,
                                            options.carry_indices ? Carry::indices : Carry::vertices, options.steering);
    case Mode::hybrid:
      return make_hybrid(points, options);
    case Mode::lod:
      if (!octree) throw Error("mode lod needs an octree");
      check_room(mode, points.size(), points.size() * kGpuBytesPerPoint, options.limits);
      return std::make_unique<Lod>(std::make_unique<MemoryLod>(points, *octree));
    case Mode::subsample:
      check_room(mode, points.size(), points.size() * kGpuBytesPerPoint, options.limits);
      return std::make_unique<Subsample>(points, options.seed);
  }
  return nullptr;
}

std::unique_ptr<Method> make_method(Mode mode, const Dataset& dataset, const MethodOptions& options) {
  if (mode == Mode::hierarchical && dataset.tree)
    return std::make_unique<Hierarchical>(
        std::make_unique<TreeSupply>(dataset.tree, dataset.colors, dataset.bytes_to_load, options.density),
        budget_within(options.limits, options.largest_budget));
  if (mode == Mode::lod && dataset.tree) return make_lod(dataset, options);
  if (mode == Mode::hybrid && dataset.tree && options.skips.nodes) return make_hybrid(dataset, options);
  return make_method(mode, dataset.points, dataset.octree ? &*dataset.octree : nullptr, options);
}

std::unique_ptr<Method> make_hybrid(const PointSet& points, const ClusterCut& cut, const MethodOptions& options) {
  const std::uint32_t budget = check_hybrid(points, options);
  return std::make_unique<Hybrid>(std::make_unique<WholeCloud>(upload_clusters(points, cut)),
                                  selector_options(options, budget));
}

}  // namespace stipple
