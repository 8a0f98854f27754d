#include "octree/open/joined_source.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <utility>

#include "octree/build/stream/common_grid.h"
#include "octree/cloud/merged_schema.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

GridBox read_bounds(const PointSource& source) {
  tbb::enumerable_thread_specific<GridBox> parts;
  source.read({}, [&](const PointBatch& batch) {
    GridBox& box = parts.local();
    for (const glm::ivec3& p : batch.positions) box.extend(p);
  });
  GridBox bounds;
  for (const GridBox& part : parts) bounds.extend(part);
  return bounds;
}

// What all have, or how many they are.
std::string common(std::span<const std::unique_ptr<PointSource>> sources, std::string SourceInfo::*member) {
  const std::string& first = sources.front()->info().*member;
  const bool same = std::ranges::all_of(sources, [&](const auto& s) { return s->info().*member == first; });
  return same ? first : "";
}

// Many small files are read at once, a large one by all threads.
void for_each_source(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t) {
    const std::size_t source = next.fetch_add(1);
    // A thread that waits for one file must not begin another: each takes memory
    tbb::this_task_arena::isolate([&] { work(source); });
  });
}

}  // namespace

JoinedSource::JoinedSource(std::vector<std::unique_ptr<PointSource>> sources, std::string path)
    : sources_(std::move(sources)) {
  info_.path = std::move(path);
  info_.format = common(sources_, &SourceInfo::format);
  info_.version = common(sources_, &SourceInfo::version);
  const std::string encoding = common(sources_, &SourceInfo::encoding);
  info_.encoding = fmt::format("{} sources{}{}", sources_.size(), encoding.empty() ? "" : ", each ", encoding);
  if (info_.format.empty()) {
    info_.format = "several formats";
    info_.version = "";
  }
  info_.schema = merged_schema(sources_);
  for (const auto& source : sources_) {
    const SourceInfo& info = source->info();
    first_.push_back(info_.point_count);
    info_.point_count += info.point_count;
    info_.dropped_points += info.dropped_points;
    for (const std::string& warning : info.warnings)
      info_.warnings.push_back(fmt::format("{}: {}", info.path, warning));
    if (info.stated_bounds.empty()) continue;
    info_.stated_bounds.min = glm::min(info_.stated_bounds.min, info.stated_bounds.min);
    info_.stated_bounds.max = glm::max(info_.stated_bounds.max, info.stated_bounds.max);
  }
  choose_grid();
}

void JoinedSource::choose_grid() {
  info_.grid = sources_.front()->info().grid;
  const auto same = [&](const auto& s) {
    return s->info().grid.offset == info_.grid.offset && s->info().grid.scale == info_.grid.scale;
  };
  if (std::ranges::all_of(sources_, same)) return;
  std::vector<GriddedBox> boxes(sources_.size());
  for_each_source(sources_.size(), [&](std::size_t s) {
    boxes[s] = {sources_[s]->info().grid, read_bounds(*sources_[s])};
  });
  info_.grid = common_grid(boxes);
  // A grid that is no multiple of another rounds by up to half a step
  glm::dvec3 rounding(0.0);
  for (const auto& source : sources_)
    if (const GridTransform transform(source->info().grid, info_.grid); !transform.exact())
      rounding = info_.grid.scale * 0.5;
  if (rounding != glm::dvec3(0.0))
    info_.warnings.push_back(fmt::format("no common grid holds all files exactly; positions move by up to {} units",
                                         std::max({rounding.x, rounding.y, rounding.z})));
}

void JoinedSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  for_each_source(sources_.size(), [&](std::size_t s) { read_one(s, attributes, consume); });
}

void JoinedSource::read_one(std::size_t s, std::span<const std::size_t> attributes,
                            const BatchConsumer& consume) const {
  const PointSource& source = *sources_[s];
  const SourceInfo& own = source.info();
  std::vector<std::size_t> asked;                  // of the source
  std::vector<std::optional<std::size_t>> places;  // of each attribute among them
  for (const std::size_t index : attributes) {
    const auto found = find_attribute(own.schema, info_.schema.at(index).name);
    places.push_back(found ? std::optional(asked.size()) : std::nullopt);
    if (found) asked.push_back(*found);
  }
  const GridTransform transform(own.grid, info_.grid);
  std::atomic<std::uint64_t> points{0};
  tbb::enumerable_thread_specific<PointBatch> batches;
  source.read(asked, [&](const PointBatch& from) {
    PointBatch& to = batches.local();
    to.first = first_[s] + from.first;
    to.positions = from.positions;
    if (!transform.identity())
      for (glm::ivec3& p : to.positions) p = transform(p);
    to.columns.resize(attributes.size());
    for (std::size_t a = 0; a < attributes.size(); ++a) {
      const Attribute& attribute = info_.schema[attributes[a]];
      if (!places[a])
        to.columns[a] = zeros(attribute, from.positions.size());
      else if (const Column& column = from.columns[*places[a]]; column.attribute == attribute)
        to.columns[a] = column;
      else
        to.columns[a] = converted(column, attribute);
    }
    points += from.positions.size();
    if (points > own.point_count) return;  // said below
    consume(to);
  });
  if (points != own.point_count)
    throw Error(
        fmt::format("{}: {} points were read, and {} were expected. The file changed or is damaged; copy or "
                    "download it again.",
                    own.path, points.load(), own.point_count));
}

}  // namespace stipple
