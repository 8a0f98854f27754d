#include "src/viewer/describe_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>

#include "octree/core/error.h"
#include "render/store/known_tree.h"
#include "render/store/tree_ids.h"

namespace stipple {
namespace {

PointValues values_of(const std::vector<Column>& columns, std::size_t i) {
  PointValues values;
  for (const Column& column : columns) {
    std::string text;
    for (int c = 0; c < column.attribute.components; ++c)
      text += fmt::format("{}{}", c ? " " : "", value_at(column, i, c));
    values.emplace_back(column.attribute.name, text);
  }
  return values;
}

std::vector<std::size_t> all_attributes(const Schema& schema) {
  std::vector<std::size_t> all(schema.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// Ends reading when the point is there.
struct Found {};

class TreeSearch {
 public:
  TreeSearch(const TreeStore& tree, std::uint32_t id, const glm::ivec3& position)
      : tree_(tree), id_(id), position_(position), world_(tree.info().source.grid.world_from_grid(position)) {}

  std::optional<PointValues> run() {
    const TreeStore::HierarchyPiece root = tree_.root_piece();
    return root.nodes.empty() ? std::nullopt : search(root, 0);
  }

 private:
  std::optional<PointValues> search(const TreeStore::HierarchyPiece& piece, std::uint32_t index) {
    const StoredNode& node = piece.nodes[index];
    const WorldBox cell = generous_cell(tree_.info(), node);
    if (!glm::all(glm::lessThanEqual(cell.min, world_)) || !glm::all(glm::lessThanEqual(world_, cell.max)))
      return std::nullopt;
    for (const auto& next : piece.continued)
      if (next.node == index) return search(tree_.read_piece(next, node), 0);
    if (auto values = look_into(node)) return values;
    for (const std::uint32_t child : node.children)
      if (child != StoredNode::kNone)
        if (auto values = search(piece, child)) return values;
    return std::nullopt;
  }

  std::optional<PointValues> look_into(const StoredNode& listed) {
    const StoredNode node = tree_.must_locate() ? tree_.locate(listed) : listed;
    if (node.points == 0) return std::nullopt;
    const std::uint32_t place = id_ - first_id_of(node);
    if (place >= node.points) return std::nullopt;
    PointBatch batch;
    tree_.read_points(node, all_attributes(tree_.info().source.schema), batch);
    if (place >= batch.positions.size() || batch.positions[place] != position_) return std::nullopt;
    PointValues values = values_of(batch.columns, place);
    values.insert(values.begin(), {"node", fmt::format("{}, {} points", name_of(node), node.points)});
    return values;
  }

  const TreeStore& tree_;
  std::uint32_t id_;
  glm::ivec3 position_;
  glm::dvec3 world_;
};

// Decimals that write every multiple of `scale` exactly; -1 where none do.
int decimals_of(double scale) {
  double power = 1.0;
  for (int decimals = 0; decimals < 12; ++decimals, power *= 10.0) {
    const double steps = scale * power;
    if (steps >= 0.5 && std::abs(steps - std::round(steps)) <= 1e-13 * steps) return decimals;
  }
  return -1;
}

}  // namespace

PointValues describe_point(const PointSource& source, std::uint64_t id) {
  std::optional<PointValues> values;
  std::mutex mutex;
  try {
    source.read(all_attributes(source.info().schema), [&](const PointBatch& batch) {
      if (id < batch.first || id - batch.first >= batch.positions.size()) return;
      const std::lock_guard lock(mutex);
      values = values_of(batch.columns, static_cast<std::size_t>(id - batch.first));
      throw Found();
    });
  } catch (const Found&) {
  }
  if (!values) throw Error(fmt::format("{}: has no point {} any more", source.info().path, id));
  return *values;
}

PointValues describe_point(const TreeStore& tree, std::uint32_t id, const glm::ivec3& position) {
  if (auto values = TreeSearch(tree, id, position).run()) return *values;
  throw Error(fmt::format("{}: the point that was picked is not there any more", tree.info().source.path));
}

std::string node_of(const Octree& octree, std::uint32_t id) {
  const auto place = std::ranges::find(octree.order, id) - octree.order.begin();
  for (const Node& node : octree.nodes) {
    if (place < node.first || place >= std::int64_t{node.first} + node.count) continue;
    StoredNode stored;
    stored.level = node.level;
    stored.cell = node.cell;
    return fmt::format("{}, {} points", name_of(stored), node.count);
  }
  return {};
}

std::string exact_text(const Grid& grid, const glm::ivec3& position, int axis) {
  const double scale = grid.scale[axis];
  const double offset = grid.offset[axis];
  const double world = grid.world_from_grid(position)[axis];
  const int of_scale = decimals_of(scale);
  const int of_offset = offset == 0.0 ? 0 : decimals_of(std::abs(offset));
  if (of_scale < 0 || of_offset < 0) return fmt::format("{}", world);
  return fmt::format("{:.{}f}", world, std::max(of_scale, of_offset));
}

}  // namespace stipple
