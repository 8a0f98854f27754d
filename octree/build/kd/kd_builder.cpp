#include "octree/build/kd/kd_builder.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <thread>

#include "octree/build/kd/kd_partition.h"
#include "octree/build/stream/inputs.h"
#include "octree/build/subtree.h"
#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "octree/core/stopwatch.h"
#include "octree/store/potree2/kd_boxes.h"
#include "octree/store/potree2/sidecar.h"
#include "octree/store/potree2/writer_folder.h"

namespace stipple {
namespace {

// Of the root's sample; fewer of small clouds, whose root is their only leaf.
constexpr std::size_t kSamplePoints = 20'000;
// Beside its record: position, code, id and rank, place in the order of its node.
constexpr std::uint64_t kKdBytesPerPoint = sizeof(glm::ivec3) + sizeof(CodedPoint) + 2 * sizeof(std::uint32_t);

void check_kd(const StreamOptions& options) {
  if (options.leaf_capacity == 0 || options.cluster_points == 0)
    throw Error("leaf capacity and cluster size of a tree must be 1 point or more");
  if (options.encoding != potree2::Encoding::uncompressed || options.sampling != Sampling::poisson)
    throw UsageError("a kd tree has plain records and samples nothing: leave out the encoding and the sampling");
}

class KdBuild {
 public:
  KdBuild(std::span<const std::unique_ptr<PointSource>> sources, const std::string& target,
          const StreamOptions& options, BuildMonitor& monitor)
      : options_(options),
        monitor_(monitor),
        threads_(tbb::global_control::max_allowed_parallelism,
                 options.threads > 0 ? static_cast<std::size_t>(options.threads) : std::thread::hardware_concurrency()),
        inputs_(sources, monitor),
        stats_(inputs_.schema()),
        folder_(target, options.replace),
        file_(folder_.path() + "/octree.bin"),
        sidecar_(folder_.path()) {
    check_memory();
  }

  BuildReport run() {
    monitor_.begin(BuildPhase::counting);
    read_until_right([this] { return inputs_.read_positions([](std::span<const glm::ivec3>) {}); });
    lap(BuildPhase::counting);
    monitor_.begin(BuildPhase::distributing);
    read();
    lap(BuildPhase::distributing);
    monitor_.begin(BuildPhase::building);
    code();
    // Those of lowest rank are an even sample
    const std::size_t sampled =
        points_.size() <= options_.leaf_capacity ? 0 : std::min(kSamplePoints, points_.size() / 2);
    const auto rest = points_.begin() + static_cast<std::ptrdiff_t>(sampled);
    std::ranges::nth_element(points_, rest, {}, [](const CodedPoint& p) { return std::pair(p.rank, p.code); });
    nodes_ = kd_partition(inputs_.grid(), positions_, std::span(points_).subspan(sampled), options_.leaf_capacity);
    for (KdNode& node : nodes_) node.first += sampled;
    if (!nodes_.empty()) nodes_.front().box.extend(inputs_.bounds());
    write_points(sampled);
    lap(BuildPhase::building);
    monitor_.begin(BuildPhase::finishing);
    finish();
    lap(BuildPhase::finishing);
    return report_;
  }

 private:
  // Points that a node holds itself.
  struct Own {
    std::uint32_t node = 0;
    std::span<CodedPoint> points;
    std::uint64_t byte_offset = 0;
    Subtree packed;
  };

  void check_memory() const {
    const std::uint64_t points = inputs_.point_count();
    const std::uint64_t bytes = points * (inputs_.record_bytes() + kKdBytesPerPoint);
    if (points >= KdNode::kNone)
      throw Error(fmt::format("a kd tree holds fewer than {} points, not {}: build an octree", KdNode::kNone, points));
    if (bytes > options_.memory)
      throw Error(
          fmt::format("a kd tree of {} points takes {} bytes of memory while it is built, and {} are allowed. "
                      "Allow more with --memory, or build an octree, which takes no more than it may.",
                      points, bytes, options_.memory));
  }

  void read() {
    const std::size_t record = inputs_.record_bytes();
    records_.resize(inputs_.point_count() * record);
    std::atomic<std::size_t> end{0};
    inputs_.read_records(stats_, [&](std::span<const std::byte> batch) {
      const std::size_t place = end.fetch_add(batch.size());
      if (place + batch.size() > records_.size()) throw changed_while_read();
      std::ranges::copy(batch, records_.begin() + static_cast<std::ptrdiff_t>(place));
      monitor_.add_points(BuildPhase::distributing, batch.size() / record);
    });
    if (end != records_.size()) throw changed_while_read();
  }

  void code() {
    const std::size_t record = inputs_.record_bytes();
    points_.resize(inputs_.point_count());
    positions_.resize(points_.size());
    if (points_.empty()) return;
    const Quantizer quantizer(inputs_.grid(), inputs_.bounds());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points_.size(), 1 << 14), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::byte* at = records_.data() + i * record;
        positions_[i] = position_of(at);
        points_[i] = {quantizer.code(positions_[i]), static_cast<std::uint32_t>(i), rank_of(at, record, options_.seed)};
      }
    });
  }

  void write_points(std::size_t sampled) {
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      const bool leaf = nodes_[n].children == KdNode::kNone;
      if (n == 0)
        own_.push_back({n, leaf ? std::span(points_) : std::span(points_).first(sampled), 0, {}});
      else if (leaf)
        own_.push_back({n, std::span(points_).subspan(nodes_[n].first, nodes_[n].count), 0, {}});
    }
    std::uint64_t end = 0;
    for (Own& own : own_) {
      own.byte_offset = end;
      end += own.points.size() * inputs_.record_bytes();
    }
    tbb::parallel_for(std::size_t{0}, own_.size(), [&](std::size_t i) { write(own_[i]); });
    for (const Own& own : own_) {
      const Node& packed = own.packed.nodes.front();
      sidecar_.add({own.byte_offset, 0, packed.count, packed.cluster_count,
                    static_cast<std::uint32_t>(nodes_[own.node].level), packed.box, packed.profile},
                   own.packed.clusters);
    }
  }

  void write(Own& own) {
    const std::size_t record = inputs_.record_bytes();
    std::sort(own.points.begin(), own.points.end());
    Node node;
    node.level = nodes_[own.node].level;
    append_node(own.packed, node, own.points, positions_,
                {.cluster_points = options_.cluster_points, .seed = options_.seed});
    Buffer<std::byte> bytes(own.points.size() * record);
    for (std::size_t i = 0; i < own.points.size(); ++i)
      copy_record(records_.data() + own.packed.order[i] * record, record, bytes.data() + i * record);
    own.packed.order = {};
    file_.write_at(own.byte_offset, bytes);
    monitor_.add_written(bytes.size());
    monitor_.add_points(BuildPhase::building, own.points.size());
  }

  // Children are the first two of eight; empty ones are none.
  Buffer<std::byte> hierarchy() const {
    Buffer<std::byte> bytes(std::max<std::size_t>(nodes_.size(), 1) * potree2::kRecordBytes);
    std::vector<potree2::Record> records(std::max<std::size_t>(nodes_.size(), 1));
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      records[n].child_mask = nodes_[n].children == KdNode::kNone ? 0 : 0b11;
    for (const Own& own : own_) {
      records[own.node].points = static_cast<std::uint32_t>(own.points.size());
      records[own.node].byte_offset = own.byte_offset;
      records[own.node].byte_size = own.points.size() * inputs_.record_bytes();
    }
    for (std::size_t n = 0; n < records.size(); ++n) {
      if (records[n].child_mask == 0) records[n].type = potree2::NodeType::leaf;
      potree2::write_record(records[n], bytes.data() + n * potree2::kRecordBytes);
    }
    return bytes;
  }

  void finish() {
    const Buffer<std::byte> hierarchy_bytes = hierarchy();
    std::vector<GridBox> boxes;
    for (const KdNode& node : nodes_) boxes.push_back(node.box);
    if (boxes.empty()) boxes.push_back({glm::ivec3(0), glm::ivec3(0)});
    const RootCube cube = root_cube(inputs_.grid(), inputs_.bounds());
    potree2::Metadata metadata;
    metadata.name = std::filesystem::path(folder_.target()).filename().string();
    metadata.points = inputs_.point_count();
    metadata.first_piece_bytes = hierarchy_bytes.size();
    metadata.depth = nodes_.empty() ? 0 : nodes_.back().level;
    metadata.step_size = metadata.depth + 1;
    metadata.grid = inputs_.grid();
    metadata.cube = {cube.min, cube.min + cube.edge};
    metadata.schema = inputs_.schema();
    metadata.ranges = stats_.ranges();
    metadata.ranges.insert(metadata.ranges.begin(), inputs_.position_range());
    const std::string text = potree2::write_metadata(metadata);
    write_file(folder_.path() + "/hierarchy.bin", hierarchy_bytes);
    potree2::write_boxes(folder_.path(), boxes);
    write_file((std::filesystem::path(folder_.path()) / potree2::kKdMetadataName).string(), text);
    file_.sync();
    const std::uint64_t sidecar_bytes =
        sidecar_.finish({.points = metadata.points, .octree_bytes = records_.size(), .seed = options_.seed});
    folder_.commit();
    report_.points = metadata.points;
    report_.nodes = nodes_.size();
    report_.depth = metadata.depth;
    report_.grid = metadata.grid;
    report_.largest_rounding = inputs_.largest_rounding();
    report_.bytes_read = monitor_.progress().bytes_read;
    report_.bytes_written =
        records_.size() + hierarchy_bytes.size() + text.size() + sidecar_bytes + boxes.size() * potree2::kBoxBytes;
  }

  void lap(BuildPhase phase) { report_.phases.push_back({phase, stopwatch_.lap()}); }

  const StreamOptions& options_;
  BuildMonitor& monitor_;
  tbb::global_control threads_;
  Inputs inputs_;
  AttributeStats stats_;
  potree2::WriterFolder folder_;
  potree2::WriterFile file_;
  potree2::SidecarWriter sidecar_;
  Buffer<std::byte> records_;
  Buffer<glm::ivec3> positions_;
  Buffer<CodedPoint> points_;
  std::vector<KdNode> nodes_;
  std::vector<Own> own_;  // in the order of nodes
  Stopwatch stopwatch_;
  BuildReport report_;
};

}  // namespace

BuildReport build_kd_tree(std::span<const std::unique_ptr<PointSource>> sources, const std::string& folder,
                          const StreamOptions& options, BuildMonitor& monitor) {
  check_kd(options);
  return KdBuild(sources, folder, options, monitor).run();
}

}  // namespace stipple
