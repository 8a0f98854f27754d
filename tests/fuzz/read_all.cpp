#include "tests/fuzz/read_all.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"

namespace stipple::fuzz {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "without an error: %s\n", what);
  std::abort();
}

void check_columns(const PointBatch& batch, std::size_t attributes) {
  require(batch.columns.size() == attributes, "another number of columns than was asked for");
  for (const Column& column : batch.columns)
    require(column.bytes.size() == batch.positions.size() * column.attribute.bytes(), "a column is not full");
}

std::vector<std::size_t> all_of(const Schema& schema) {
  std::vector<std::size_t> attributes(schema.size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  return attributes;
}

void read_source(const PointSource& source, const std::vector<std::size_t>& attributes) {
  std::atomic<std::uint64_t> points{0};
  source.read(attributes, [&](const PointBatch& batch) {
    check_columns(batch, attributes.size());
    points += batch.positions.size();
  });
  require(points == source.info().point_count, "another number of points than the source has");
}

void read_nodes(const TreeStore& store) {
  const auto attributes = all_of(store.info().source.schema);
  PointBatch batch;
  for (const StoredNode& node : uppermost_nodes(store)) {
    if (store.info().has_details) store.read_details(node);
    store.read_points(node, attributes, batch);
    check_columns(batch, attributes.size());
    require(batch.positions.size() == node.points, "another number of points than the node has");
    const std::uint64_t first = node.points / 3;
    const std::uint64_t count = node.points / 2;
    store.read_part(node, first, count, attributes, batch);
    check_columns(batch, attributes.size());
    require(batch.positions.size() == count, "another number of points than the part has");
  }
}

}  // namespace

void read_all(const std::string& path) {
  const auto source = open_source(path);
  read_source(*source, all_of(source->info().schema));
  read_source(*source, {});
  if (is_tree(path)) read_nodes(*open_tree(path));
}

}  // namespace stipple::fuzz
