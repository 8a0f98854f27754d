#include "render/method/method.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "octree/core/error.h"
#include "render/method/brute_force.h"
#include "render/method/hierarchical.h"
#include "render/method/hybrid.h"
#include "render/method/unstructured.h"
#include "render/store/cluster_cloud.h"
#include "render/store/memory_supply.h"
#include "render/store/tree_supply.h"

namespace stipple {
namespace {

constexpr std::array kModes{Mode::brute_force, Mode::hierarchical, Mode::unstructured, Mode::hybrid};

// Of modes that keep all points on the GPU.
void check_room(Mode mode, std::size_t points, std::uint64_t bytes, const MemoryLimits& limits) {
  if (bytes <= limits.gpu) return;
  throw Error(
      fmt::format("mode {} keeps all {} points on the GPU, {} bytes, and {} are allowed. Allow more with "
                  "--gpu-memory, or draw in mode hierarchical.",
                  name_of(mode), points, bytes, limits.gpu));
}

ClusterSelector::Options selector_options(const MethodOptions& options, std::uint32_t budget) {
  return {.largest_budget = budget, .skip_occluded = options.skip_occluded, .by_yield = options.by_yield};
}

std::unique_ptr<Method> make_hybrid(const PointSet& points, const MethodOptions& options) {
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
  return std::make_unique<Hybrid>(std::make_unique<WholeCloud>(upload_clusters(points)),
                                  selector_options(options, budget));
}

}  // namespace

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
  }
  return "";
}

std::optional<Mode> mode_named(std::string_view name) {
  for (const Mode mode : kModes)
    if (name_of(mode) == name) return mode;
  return std::nullopt;
}

DatasetNeeds needs_of(Mode mode) {
  const bool octree = mode == Mode::hierarchical;
  return {.points = !octree, .octree = octree};
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
      return std::make_unique<Hierarchical>(std::make_unique<MemorySupply>(points, *octree),
                                            std::min(budget_within({.gpu = options.limits.gpu}, options.largest_budget),
                                                     static_cast<std::uint32_t>(points.size())));
    case Mode::unstructured:
      check_room(mode, points.size(), points.size() * kGpuBytesPerPoint, options.limits);
      return std::make_unique<Unstructured>(points, options.seed);
    case Mode::hybrid:
      return make_hybrid(points, options);
  }
  return nullptr;
}

std::unique_ptr<Method> make_method(Mode mode, const Dataset& dataset, const MethodOptions& options) {
  if (mode == Mode::hierarchical && dataset.tree)
    return std::make_unique<Hierarchical>(
        std::make_unique<TreeSupply>(dataset.tree, dataset.colors, dataset.bytes_to_load),
        budget_within(options.limits, options.largest_budget));
  return make_method(mode, dataset.points, dataset.octree ? &*dataset.octree : nullptr, options);
}

}  // namespace stipple
