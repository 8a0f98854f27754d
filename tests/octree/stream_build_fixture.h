// Sources made of test clouds, and trees read back whole.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "octree/build/stream/record.h"
#include "octree/build/stream/sampler.h"
#include "octree/build/stream/tree_builder.h"
#include "octree/core/error.h"
#include "octree/store/open_tree.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test {

namespace fs = std::filesystem;

// Positions with three attributes made from the index of the point, so that each can be told from its neighbours.
class CloudSource : public PointSource {
 public:
  explicit CloudSource(TestCloud cloud, std::uint64_t first_id = 0) : cloud_(std::move(cloud)), first_id_(first_id) {
    info_.path = cloud_.name;
    info_.point_count = cloud_.positions.size();
    info_.grid = cloud_.grid;
    info_.schema = {{"intensity", ScalarType::u16, 1, 1.0, 0.0},
                    {"rgb", ScalarType::u16, 3, 1.0, 0.0},
                    {"classification", ScalarType::u8, 1, 1.0, 0.0},
                    {"gps-time", ScalarType::f64, 1, 1.0, 0.0}};
    if (!cloud_.positions.empty()) info_.stated_bounds = world_box(cloud_.grid, cloud_.bounds());
  }

  SourceInfo& info() { return info_; }
  const SourceInfo& info() const override { return info_; }
  std::size_t fail_after = std::numeric_limits<std::size_t>::max();  // points

  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override {
    constexpr std::size_t kBatch = 5'000;
    for (std::size_t first = 0; first < cloud_.positions.size(); first += kBatch) {
      if (first >= fail_after && !attributes.empty()) throw Error("the test's source broke off");
      const std::size_t count = std::min(kBatch, cloud_.positions.size() - first);
      PointBatch batch;
      batch.first = first;
      batch.positions.assign(cloud_.positions.begin() + first, cloud_.positions.begin() + first + count);
      for (const std::size_t a : attributes) batch.columns.push_back(column(a, first, count));
      consume(batch);
    }
  }

 private:
  Column column(std::size_t a, std::size_t first, std::size_t count) const {
    Column column{info_.schema[a], {}};
    column.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t id = first_id_ + first + i;
      if (a == 0) column.as<std::uint16_t>()[i] = static_cast<std::uint16_t>(id * 7);
      if (a == 1)
        for (std::size_t c = 0; c < 3; ++c)
          column.as<std::uint16_t>()[3 * i + c] = static_cast<std::uint16_t>(id >> (4 * c));
      if (a == 2) column.as<std::uint8_t>()[i] = static_cast<std::uint8_t>(id % 5);
      if (a == 3) column.as<double>()[i] = static_cast<double>(id) * 0.5;
    }
    return column;
  }

  TestCloud cloud_;
  std::uint64_t first_id_;
  SourceInfo info_;
};

using Sources = std::vector<std::unique_ptr<PointSource>>;

inline Sources sources_of(TestCloud cloud) {
  Sources sources;
  sources.push_back(std::make_unique<CloudSource>(std::move(cloud)));
  return sources;
}

// Position and all attributes of a point, as bytes: equal points have equal ones.
inline std::vector<std::string> records_of(const PointBatch& batch) {
  std::vector<std::string> records(batch.positions.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].assign(reinterpret_cast<const char*>(&batch.positions[i]), sizeof(glm::ivec3));
    for (const Column& column : batch.columns) {
      const std::size_t bytes = column.attribute.bytes();
      records[i].append(reinterpret_cast<const char*>(column.bytes.data() + i * bytes), bytes);
    }
  }
  return records;
}

inline std::vector<std::size_t> all_attributes(const Schema& schema) {
  std::vector<std::size_t> all(schema.size());
  for (std::size_t a = 0; a < all.size(); ++a) all[a] = a;
  return all;
}

inline std::vector<std::string> sorted_records(const PointSource& source) {
  std::vector<std::string> records;
  source.read(all_attributes(source.info().schema), [&](const PointBatch& batch) {
    for (std::string& record : records_of(batch)) records.push_back(std::move(record));
  });
  std::ranges::sort(records);
  return records;
}

struct ReadNode {
  StoredNode node;
  PointBatch points;
};

struct ReadTree {
  TreeInfo info;
  std::vector<ReadNode> nodes;

  std::vector<std::string> sorted_records() const {
    std::vector<std::string> records;
    for (const ReadNode& node : nodes)
      for (std::string& record : records_of(node.points)) records.push_back(std::move(record));
    std::ranges::sort(records);
    return records;
  }
};

inline ReadTree read_tree(const std::string& folder) {
  const auto store = open_tree(folder);
  ReadTree tree{store->info(), {}};
  const std::vector<std::size_t> all = all_attributes(tree.info.source.schema);
  for (const StoredNode& node : read_whole_hierarchy(*store)) {
    ReadNode& read = tree.nodes.emplace_back(ReadNode{node, {}});
    for (const std::size_t a : all) read.points.columns.push_back({tree.info.source.schema[a], {}});
    if (node.points > 0) store->read_points(node, all, read.points);
  }
  return tree;
}

inline std::string file_content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A folder of its own for each test, empty at first and gone at the end.
class StreamBuild : public testing::Test {
 protected:
  StreamBuild() { fs::create_directories(folder_); }
  ~StreamBuild() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  static StreamOptions small_nodes() {
    StreamOptions options;
    options.leaf_capacity = 500;
    options.cluster_points = 100;
    options.chunk_points = 3'000;
    return options;
  }

  BuildReport build(const Sources& sources, const std::string& name, const StreamOptions& options) const {
    BuildMonitor monitor;
    return build_tree(sources, path(name), options, monitor);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("stipple-stream-" + std::to_string(::getpid()));
};

}  // namespace stipple::test
