#include "src/check/compare_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <mutex>
#include <tuple>
#include <unordered_map>

#include "octree/build/hash.h"
#include "src/check/canonical.h"

namespace stipple {
namespace {

constexpr std::size_t kBuckets = 4096;

struct PointHash {
  std::uint64_t a = 0x243f6a8885a308d3u;  // digits of pi: two different starts
  std::uint64_t b = 0x13198a2e03707344u;

  void add(std::uint64_t value) {
    a = mix64(a + value);
    b = mix64((b ^ value) * 0x9e3779b97f4a7c15u);
  }
  std::size_t bucket() const { return a % kBuckets; }
  bool operator==(const PointHash&) const = default;
};

struct HashOfHash {
  std::size_t operator()(const PointHash& hash) const { return hash.b; }
};

// What stands for all points of one bucket.
struct Sums {
  std::uint64_t count = 0;
  std::uint64_t a = 0;
  std::uint64_t b = 0;

  void add(const Sums& other) {
    count += other.count;
    a += other.a;
    b += other.b;
  }
  bool operator==(const Sums&) const = default;
};

using BucketSums = std::vector<Sums>;

void add_value(const std::byte* at, std::size_t bytes, PointHash& hash) {
  for (std::size_t done = 0; done < bytes; done += 8) {
    std::uint64_t value = 0;
    std::memcpy(&value, at + done, std::min<std::size_t>(8, bytes - done));
    hash.add(value);
  }
}

void hash_points(const CanonicalBatch& batch, std::vector<PointHash>& hashes) {
  hashes.assign(batch.positions.size(), PointHash{});
  for (std::size_t i = 0; i < hashes.size(); ++i)
    add_value(reinterpret_cast<const std::byte*>(&batch.positions[i]), sizeof(glm::ivec3), hashes[i]);
  for (const Column& column : batch.columns) {
    const std::size_t bytes = column.attribute.bytes();
    for (std::size_t i = 0; i < hashes.size(); ++i) add_value(column.bytes.data() + i * bytes, bytes, hashes[i]);
  }
}

// What one thread reuses from batch to batch.
struct Workspace {
  CanonicalBatch points;
  std::vector<PointHash> hashes;
  BucketSums sums = BucketSums(kBuckets);
  double largest_rounding = 0.0;
};

using Workspaces = tbb::enumerable_thread_specific<Workspace>;

// Converts and hashes all points of a source, and hands on every batch, from several threads at once.
void for_each_hashed(const PointSource& source, const Conversion& conversion, Workspaces& workspaces,
                     const std::function<void(Workspace&)>& consume) {
  source.read(conversion.asked, [&](const PointBatch& batch) {
    Workspace& workspace = workspaces.local();
    convert(conversion, batch, workspace.points);
    hash_points(workspace.points, workspace.hashes);
    consume(workspace);
  });
}

// The sums of one source are added to `sums`. Returns the largest rounding.
double add_source(const PointSource& source, const Conversion& conversion, BucketSums& sums) {
  Workspaces workspaces;
  for_each_hashed(source, conversion, workspaces, [](Workspace& workspace) {
    for (const PointHash& hash : workspace.hashes) workspace.sums[hash.bucket()].add({1, hash.a, hash.b});
    workspace.largest_rounding = std::max(workspace.largest_rounding, workspace.points.largest_rounding);
  });
  double largest_rounding = 0.0;
  for (const Workspace& workspace : workspaces) {
    for (std::size_t i = 0; i < kBuckets; ++i) sums[i].add(workspace.sums[i]);
    largest_rounding = std::max(largest_rounding, workspace.largest_rounding);
  }
  return largest_rounding;
}

// How often one point is where, and what it looks like.
struct Occurrences {
  std::uint64_t in_tree = 0;
  std::uint64_t in_inputs = 0;
  std::size_t source = 0;  // 0: the tree; then the inputs
  std::uint64_t id = 0;    // the lowest in that source
  glm::ivec3 position{0};
  std::vector<Column> values;  // of this one point

  auto place() const { return std::tuple(source, id); }
};

// The different points of one bucket.
class Bucket {
 public:
  explicit Bucket(std::size_t index) : index_(index) {}

  void add(std::size_t source, const Workspace& workspace) {
    for (std::size_t i = 0; i < workspace.hashes.size(); ++i)
      if (workspace.hashes[i].bucket() == index_) add(source, workspace, i);
  }

  // The first, by source and id, that is not as often in the tree as in the inputs.
  const Occurrences* first_difference() const {
    const Occurrences* first = nullptr;
    for (const auto& [hash, point] : points_)
      if (point.in_tree != point.in_inputs && (!first || point.place() < first->place())) first = &point;
    return first;
  }

 private:
  void add(std::size_t source, const Workspace& workspace, std::size_t i) {
    const std::scoped_lock lock(mutex_);
    Occurrences& point = points_[workspace.hashes[i]];
    const bool known = point.in_tree + point.in_inputs > 0;
    ++(source == 0 ? point.in_tree : point.in_inputs);
    const std::uint64_t id = workspace.points.first + i;
    if (known && point.place() <= std::tuple(source, id)) return;
    point.source = source;
    point.id = id;
    point.position = workspace.points.positions[i];
    point.values.clear();
    for (const Column& column : workspace.points.columns) {
      const auto begin = column.bytes.begin() + static_cast<std::ptrdiff_t>(i * column.attribute.bytes());
      const auto end = begin + static_cast<std::ptrdiff_t>(column.attribute.bytes());
      point.values.push_back({column.attribute, {begin, end}});
    }
  }

  std::size_t index_;
  std::mutex mutex_;
  std::unordered_map<PointHash, Occurrences, HashOfHash> points_;
};

std::string words_for(const Occurrences& point, const Grid& grid) {
  const glm::dvec3 world = grid.world_from_grid(point.position);
  std::string text = fmt::format("({}, {}, {})", world.x, world.y, world.z);
  for (const Column& column : point.values) {
    std::vector<double> values;
    for (int c = 0; c < column.attribute.components; ++c) values.push_back(value_at(column, 0, c));
    text += fmt::format(", {} {}", column.attribute.name, fmt::join(values, " "));
  }
  return text;
}

Defect describe(const Occurrences& point, const TreeSource& tree,
                std::span<const std::unique_ptr<PointSource>> inputs) {
  const std::string text = words_for(point, tree.info().grid);
  if (point.in_tree == 0)
    return {"", fmt::format("point {} of {} is not in the tree as often as in the inputs (0 and {}): {}", point.id,
                            inputs[point.source - 1]->info().path, point.in_inputs, text)};
  return {name_of(tree.node_of(point.id)),
          fmt::format("its point is {} times in the tree and {} times in the inputs: {}", point.in_tree,
                      point.in_inputs, text)};
}

// Sorts the attributes of both sides into those compared and those not. Returns the former as the tree has them.
Schema attributes_of_both(const SourceInfo& tree, std::span<const std::unique_ptr<PointSource>> inputs,
                          Comparison& result) {
  const auto same = [](const Attribute& a) {
    return [&a](const Attribute& b) { return a.name == b.name && a.components == b.components; };
  };
  Schema both;
  for (const Attribute& attribute : tree.schema) {
    const bool found = std::ranges::any_of(
        inputs, [&](const auto& input) { return std::ranges::any_of(input->info().schema, same(attribute)); });
    (found ? result.compared : result.in_tree_only).push_back(attribute.name);
    if (found) both.push_back(attribute);
  }
  for (const auto& input : inputs)
    for (const Attribute& attribute : input->info().schema)
      if (std::ranges::none_of(tree.schema, same(attribute)) &&
          std::ranges::find(result.in_inputs_only, attribute.name) == result.in_inputs_only.end())
        result.in_inputs_only.push_back(attribute.name);
  return both;
}

}  // namespace

Comparison compare_points(const TreeSource& tree, std::span<const std::unique_ptr<PointSource>> inputs) {
  Comparison result;
  const Schema schema = attributes_of_both(tree.info(), inputs, result);
  const Conversion from_tree = conversion_of(tree.info(), tree.info().grid, schema);
  std::vector<Conversion> from_input;
  for (const auto& input : inputs) from_input.push_back(conversion_of(input->info(), tree.info().grid, schema));

  BucketSums of_tree(kBuckets), of_inputs(kBuckets);
  add_source(tree, from_tree, of_tree);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    result.input_points += inputs[i]->info().point_count;
    result.largest_rounding = std::max(result.largest_rounding, add_source(*inputs[i], from_input[i], of_inputs));
  }
  const auto [different, unused] = std::ranges::mismatch(of_tree, of_inputs);
  if (different == of_tree.end()) return result;

  // Again, to see which points of the bucket differ
  Bucket bucket(static_cast<std::size_t>(different - of_tree.begin()));
  Workspaces workspaces;
  for_each_hashed(tree, from_tree, workspaces, [&](const Workspace& w) { bucket.add(0, w); });
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for_each_hashed(*inputs[i], from_input[i], workspaces, [&](const Workspace& w) { bucket.add(i + 1, w); });
  if (const Occurrences* point = bucket.first_difference()) {
    result.defect = describe(*point, tree, inputs);
  } else {
    result.defect = Defect{"", "the points of the tree or of an input changed while they were compared"};
  }
  return result;
}

}  // namespace stipple
