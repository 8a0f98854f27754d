#include "render/method/cluster_selector.h"

#include <algorithm>
#include <string>
#include <utility>

namespace stipple {
namespace {

// Layouts of shaders/clusters.glsl.
struct ClusterState {
  std::uint32_t start, drawn, status;
  float seen;
  glm::uvec4 hidden;
};
struct Stretch {
  std::uint32_t cluster, begin, first, count;
};
struct Totals {
  std::uint32_t points, stretches, open;
  std::int32_t cut;
  std::uint32_t allowance;
  float factor;
};
struct Sight {
  std::uint32_t visible, occluded;
};
struct ChunkBegin {
  std::uint32_t point, stretch;
};
constexpr std::uint32_t kOutside = 0;
constexpr std::uint32_t kOpen = 1;
constexpr std::uint32_t kOccluded = 2;
constexpr std::size_t kUrgencies = 1024;
constexpr std::size_t kSummaryHead = sizeof(Totals) + ClusterTable::kMostChunks * sizeof(ChunkBegin);

constexpr std::size_t kProspectBytes = 3 * sizeof(float);
constexpr std::size_t kSilhouetteBytes = 4 * sizeof(std::uint32_t);
constexpr std::size_t kMostProbed = 4096;

// Clusters that one invocation of the scan works off; a bit each in a word. Shards are a bit each in two.
constexpr std::size_t kBlock = ClusterTable::kBlock;
static_assert(kBlock == 32 && kShards == 64);

std::size_t blocks_of(std::size_t clusters) {
  return (clusters + kBlock - 1) / kBlock;
}

Program compile(const char* shader, std::vector<ShaderDefine> defines = {}) {
  defines.push_back({"MOST_CHUNKS", std::to_string(ClusterTable::kMostChunks)});
  defines.push_back({"LEVELS", std::to_string(ClusterTable::kLevels) + "u"});
  defines.push_back({"BLOCK", std::to_string(kBlock) + "u"});
  defines.push_back({"SHARDS", std::to_string(kShards) + "u"});
  return Program::compute(shader, defines);
}

}  // namespace

ClusterSelector::ClusterSelector(const ClusterTable& table, const Options& options)
    : table_(&table),
      options_(options),
      eyes_(1),
      looks_of_one_(compile_looks({})),
      score_(compile("select_score.glsl")),
      cut_(compile("select_cut.glsl")),
      sums_(compile("select_scan.glsl", {{"SCAN_SUMS"}})),
      scan_(compile("select_scan.glsl")),
      take_(compile("select_take.glsl")),
      expand_(compile("expand_stretch.glsl")),
      yield_(compile("measure_yield.glsl")),
      test_shards_(compile_depth_test("test_shards.glsl", {})),
      states_(table.capacity * sizeof(ClusterState)),
      open_clusters_(2 * table.capacity * sizeof(std::uint32_t)),
      wishes_(table.capacity * sizeof(std::uint32_t)),
      wishing_(blocks_of(table.capacity) * sizeof(std::uint32_t)),
      sight_(sizeof(Sight)),
      summary_(kSummaryHead + kUrgencies * sizeof(std::uint32_t)),
      silhouettes_(table.capacity * kSilhouetteBytes),
      prospects_(table.capacity * kProspectBytes),
      block_sums_(blocks_of(table.capacity) * sizeof(glm::uvec4)),
      stretches_(table.capacity * sizeof(Stretch)),
      places_(options.largest_budget * sizeof(std::uint32_t)) {
  forget();
}

ClusterSelector::Looks ClusterSelector::compile_looks(const std::vector<ShaderDefine>& defines) {
  return {compile("select_outline.glsl", defines), compile_depth_test("select_test.glsl", defines)};
}

ClusterSelector::DepthTest ClusterSelector::compile_depth_test(const char* shader, std::vector<ShaderDefine> defines) {
  Program from_image = compile(shader, defines);
  defines.push_back({"FROM_ATTACHMENT"});
  return {std::move(from_image), compile(shader, std::move(defines))};
}

void ClusterSelector::use(const DepthTest& pass, const Eye& eye) {
  const bool attached = eye.drawn->depth_storage() == DepthStorage::attachment;
  (attached ? pass.from_attachment : pass.from_image).use();
  eye.drawn->depth().bind(0);
  eye.pyramid.values().bind_storage(3);
  glUniform4uiv(5, DepthPyramid::kMostLevels, &eye.pyramid.level_table()[0].first);
}

std::uint64_t ClusterSelector::bytes_for(std::uint64_t clusters, std::uint64_t budget) {
  return clusters *
             (sizeof(ClusterState) + sizeof(Stretch) + 3 * sizeof(std::uint32_t) + kSilhouetteBytes + kProspectBytes) +
         budget * sizeof(std::uint32_t);
}

void ClusterSelector::forget() {
  states_.fill(0);
  wishing_.fill(0);
  close_eyes();
}

void ClusterSelector::warm_up(const View& view, const FeedbackTarget& frame) {
  const ClusterTable* const table = table_;
  ClusterTable small;
  small.chunks.push_back({GpuBuffer(2 * sizeof(PackedPoint)), GpuBuffer(2 * sizeof(std::uint32_t))});
  small.chunks[0].points.fill(0);
  small.chunks[0].ids.fill(0);
  // Of its two points a frame draws one, so that the second frame has something to test
  const ClusterTable::Row row{glm::ivec3(0), 0, glm::ivec3(0), 2};
  small.allocate(1);
  small.write_rows(0, {&row, 1});
  small.log_pixels.fill(0);
  small.shards.fill(0);
  small.size = 1;
  table_ = &small;
  forget();
  start_view(view);
  for (int frames = 0; frames < 2; ++frames) {
    for (std::size_t eye = 0; eye < view.eyes(); ++eye) see(frame, eye);
    select(view, 1);
    learn_yield(frame);
  }
  table_ = table;
  forget();
}

void ClusterSelector::start_view(const View& view) {
  close_eyes();
  if (eyes_open_ != view.eyes()) probe_.reset();
  eyes_open_ = view.eyes();
  if (eyes_open_ == 1) return;
  to_second_eye_ = glm::vec3(view.right * view.eyes_apart);
  if (looks_of_two_) return;
  looks_of_two_ = compile_looks({{"TWO_EYES"}});
  eyes_.emplace_back();
  silhouettes_ = GpuBuffer(2 * silhouettes_.bytes());
}

void ClusterSelector::close_eyes() {
  for (Eye& eye : eyes_) eye.drawn = nullptr;
  selected_ = false;
  added_ = 0;
}

bool ClusterSelector::sees_depth() const {
  return options_.skips.occlusion && std::all_of(eyes_.begin(), eyes_.begin() + static_cast<std::ptrdiff_t>(eyes_open_),
                                                 [](const Eye& eye) { return eye.drawn != nullptr; });
}

ClusterSelector::Result ClusterSelector::select(const View& view, std::uint32_t budget) {
  const bool new_view = !selected_;
  selected_ = true;
  taken_.clear();
  if (new_view) view_points_ = rounds_joined_ = 0;
  if (table_->size == 0) return {};
  Tested tested{table_->boxes, table_->log_pixels, states_,  sight_,
                silhouettes_,  prospects_,         new_view, table_->capacity};
  if (new_view) {
    sight_.fill(0);
    outline(tested, 0, table_->size);
  } else {
    outline(tested, open_ - added_, added_);
  }
  tested.all = new_view || !options_.skips.done;
  const std::uint32_t looked_at = tested.all ? table_->size : open_;
  if (sees_depth() && (seen_anew_ || added_ > 0)) test(tested, looked_at);
  seen_anew_ = false;
  added_ = 0;
  score(view, looked_at, tested.all);
  rank(std::min(budget, options_.largest_budget));
  Result result = read_back();
  open_ = result.open;
  taken_ = result.chunks;
  view_points_ += result.points;

  expand_.use();
  places_.bind_storage(2);
  glUniform1ui(0, stretches());
  dispatch_items(stretches(), 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  return result;
}

void ClusterSelector::outline(const Tested& tested, std::uint32_t first, std::uint32_t count) {
  looks().outline.use();
  tested.boxes.bind_storage(0);
  tested.states.bind_storage(1);
  tested.log_pixels.bind_storage(2);
  open_clusters_.bind_storage(4);
  tested.sight.bind_storage(5);
  tested.silhouettes.bind_storage(6);
  tested.prospects.bind_storage(7);
  glUniform1ui(0, count);
  glUniform1ui(1, first);
  glUniform1i(2, tested.all ? 1 : 0);
  glUniform1i(3, DepthPyramid::kMostLevels);
  glUniform1f(4, static_cast<float>(table_->root_edge));
  glUniform1i(7, options_.skips.frustum ? 1 : 0);
  if (eyes_open_ == 2) {
    glUniform1ui(5, tested.capacity);
    glUniform3fv(6, 1, &to_second_eye_.x);
  }
  dispatch_items(count, 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ClusterSelector::test(const Tested& tested, std::uint32_t count) {
  for (std::size_t eye = 0; eye < eyes_open_; ++eye) test(tested, count, eye);
}

void ClusterSelector::test(const Tested& tested, std::uint32_t count, std::size_t eye) {
  use(looks().test, eyes_[eye]);
  tested.states.bind_storage(1);
  open_clusters_.bind_storage(4);
  tested.sight.bind_storage(5);
  tested.silhouettes.bind_storage(6);
  tested.prospects.bind_storage(7);
  glUniform1ui(0, count);
  glUniform1i(2, tested.all ? 1 : 0);
  if (eyes_open_ == 2) {
    glUniform1ui(1, eye == 0 ? 0 : tested.capacity);
    glUniform1i(4, eye == 0 ? 0 : 1);
  }
  dispatch_items(count, 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ClusterSelector::add(std::span<const ClusterRun> runs) {
  std::vector<ClusterState> fresh;
  std::vector<std::uint32_t> clusters;
  for (const ClusterRun& run : runs) {
    fresh.assign(run.count, {0, 0, kOpen, 1.0f, glm::uvec4(0)});
    states_.write(run.first * sizeof(ClusterState), std::span<const ClusterState>(fresh));
    for (std::uint32_t i = 0; i < run.count; ++i) clusters.push_back(run.first + i);
  }
  if (!selected_) return;  // the first select() of a view tests all
  open_clusters_.write(open_ * sizeof(std::uint32_t), std::span<const std::uint32_t>(clusters));
  open_ += static_cast<std::uint32_t>(clusters.size());
  added_ += static_cast<std::uint32_t>(clusters.size());
}

void ClusterSelector::remove(std::span<const ClusterRun> runs) {
  for (const ClusterRun& run : runs) {
    const std::vector<ClusterState> none(run.count, {0, 0, kOutside, 0.0f, glm::uvec4(0)});
    states_.write(run.first * sizeof(ClusterState), std::span<const ClusterState>(none));
  }
}

std::vector<std::uint32_t> ClusterSelector::open_clusters() const {
  std::vector<std::uint32_t> clusters(selected_ ? open_ : 0);
  if (!clusters.empty()) open_clusters_.read(0, clusters.data(), clusters.size() * sizeof(std::uint32_t));
  return clusters;
}

std::vector<SightedBox> ClusterSelector::boxes() const {
  using State = SightedBox::State;
  std::vector<ClusterTable::Row> rows(table_->size);
  std::vector<ClusterState> states(table_->size);
  if (table_->size == 0) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  table_->boxes.read(0, rows.data(), rows.size() * sizeof(ClusterTable::Row));
  states_.read(0, states.data(), states.size() * sizeof(ClusterState));
  std::vector<SightedBox> boxes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].count == 0 || states[i].status == kOutside) continue;
    const State state = states[i].drawn >= rows[i].count ? State::complete
                        : states[i].status == kOccluded  ? State::occluded
                        : states[i].drawn > 0            ? State::streamed
                                                         : State::waiting;
    boxes.push_back({{rows[i].low, rows[i].high}, state});
  }
  return boxes;
}

SkipCounts ClusterSelector::skipped() const {
  // As in the shader
  struct {
    std::uint32_t clusters_outside, points_outside, clusters_hidden, clusters_done, points_in_sight, points_open,
        points_put_off;
  } counted{};
  if (!selected_ || table_->size == 0) return {};
  GpuBuffer counts(sizeof counted);
  counts.fill(0);
  const Program count = compile("count_skips.glsl");
  count.use();
  table_->boxes.bind_storage(0);
  states_.bind_storage(1);
  counts.bind_storage(2);
  prospects_.bind_storage(7);
  glUniform1ui(0, table_->size);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  dispatch_items(table_->size, 64);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  counts.read(0, &counted, sizeof counted);
  // Of clusters that gave way to others only what they drew is known
  const std::uint64_t shown = view_points_ + counted.points_open;
  return {.clusters_outside = counted.clusters_outside,
          .points_outside = counted.points_outside,
          .clusters_hidden = counted.clusters_hidden,
          .points_hidden = std::max<std::uint64_t>(counted.points_in_sight, shown) - shown,
          .points_put_off = counted.points_put_off,
          .clusters_done = counted.clusters_done,
          .rounds_joined = rounds_joined_};
}

std::vector<bool> ClusterSelector::hidden(std::span<const GridBox> boxes) {
  if (!probe_) {
    probe_.emplace(Probe{GpuBuffer(kMostProbed * sizeof(ClusterTable::Row)),
                         GpuBuffer(kMostProbed * ClusterTable::kLevels * sizeof(float)),
                         GpuBuffer(kMostProbed * sizeof(ClusterState)), GpuBuffer(sizeof(Sight)),
                         GpuBuffer(eyes_open_ * kMostProbed * kSilhouetteBytes),
                         GpuBuffer(kMostProbed * kProspectBytes)});
    probe_->log_pixels.fill(0);
  }
  std::vector<bool> result;
  for (; !boxes.empty(); boxes = boxes.subspan(std::min(boxes.size(), kMostProbed))) {
    const auto some = boxes.first(std::min(boxes.size(), kMostProbed));
    std::vector<ClusterTable::Row> rows;
    for (const GridBox& box : some) rows.push_back({box.min, 0, box.max, 1});
    probe_->boxes.write(0, std::span<const ClusterTable::Row>(rows));
    probe_->states.fill(0);
    const Tested tested{probe_->boxes,       probe_->log_pixels, probe_->states, probe_->sight,
                        probe_->silhouettes, probe_->prospects,  true,           kMostProbed};
    outline(tested, 0, static_cast<std::uint32_t>(some.size()));
    test(tested, static_cast<std::uint32_t>(some.size()));
    std::vector<ClusterState> states(some.size());
    probe_->states.read(0, states.data(), states.size() * sizeof(ClusterState));
    for (const ClusterState& state : states) result.push_back(state.status != kOpen);
  }
  return result;
}

void ClusterSelector::score(const View& view, std::uint32_t count, bool all) {
  summary_.fill(0);
  table_->boxes.bind_storage(0);
  states_.bind_storage(1);
  open_clusters_.bind_storage(2);
  wishing_.bind_storage(3);
  wishes_.bind_storage(4);
  summary_.bind_storage(5);
  prospects_.bind_storage(7);
  score_.use();
  glUniform1ui(0, count);
  glUniform1i(1, options_.skips.yield ? 1 : 0);
  glUniform1f(2, static_cast<float>(view.near));
  glUniform1i(3, all ? 1 : 0);
  glUniform1i(4, options_.skips.density ? 1 : 0);
  dispatch_items(count, 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ClusterSelector::rank(std::uint32_t budget) {
  open_clusters_.bind_storage(2);
  block_sums_.bind_storage(6);
  stretches_.bind_storage(7);
  cut_.use();
  glUniform1ui(0, budget);
  glUniform1i(1, options_.skips.rounds ? 1 : 0);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const auto blocks = static_cast<GLuint>(blocks_of(table_->size));
  sums_.use();
  glUniform1ui(0, blocks);
  dispatch_items(blocks, 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  scan_.use();
  glUniform1ui(0, blocks);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  take_.use();
  glUniform1ui(0, blocks);
  dispatch_items(blocks, 64);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

ClusterSelector::Result ClusterSelector::read_back() {
  struct {
    Totals totals;
    std::array<ChunkBegin, ClusterTable::kMostChunks + 1> begins;
  } head;
  const std::size_t chunks = table_->chunks.size();
  summary_.read(0, &head, sizeof(Totals) + chunks * sizeof(ChunkBegin));
  head.begins[chunks] = {head.totals.points, head.totals.stretches};
  Sight sight{};
  sight_.read(0, &sight, sizeof sight);
  if (head.totals.factor > 1.0f) ++rounds_joined_;
  Result result{{}, head.totals.points, head.totals.open, sight.visible, sight.occluded};
  for (std::size_t c = 0; c < chunks; ++c) {
    const ChunkBegin& begin = head.begins[c];
    const ChunkBegin& end = head.begins[c + 1];
    result.chunks.push_back({begin.point, end.point - begin.point, begin.stretch, end.stretch - begin.stretch});
  }
  return result;
}

void ClusterSelector::learn_yield(const FeedbackTarget& frame) {
  if (!options_.skips.yield) return;
  yield_.use();
  frame.ids().bind(1);
  states_.bind_storage(2);
  places_.bind_storage(3);
  table_->boxes.bind_storage(4);
  stretches_.bind_storage(7);
  for (std::size_t c = 0; c < taken_.size(); ++c) {
    if (taken_[c].stretches == 0) continue;
    table_->chunks[c].points.bind_storage(0);
    table_->chunks[c].ids.bind_storage(1);
    glUniform1ui(0, taken_[c].first_stretch);
    glUniform1ui(1, taken_[c].first_stretch + taken_[c].stretches);
    dispatch_items((taken_[c].stretches + 1) / 2, 64);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ClusterSelector::see(const FeedbackTarget& frame, std::size_t eye) {
  eyes_[eye].drawn = &frame;
  seen_anew_ = true;
  if (!options_.skips.occlusion) return;
  eyes_[eye].pyramid.build(frame);
  if (!selected_) return;
  test_shards(eye);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ClusterSelector::test_shards(std::size_t eye) {
  use(test_shards_, eyes_[eye]);
  table_->boxes.bind_storage(0);
  states_.bind_storage(1);
  table_->shards.bind_texels(1, GL_RG32UI);
  sight_.bind_storage(5);
  stretches_.bind_storage(7);
  glUniform1ui(0, stretches());
  glUniform1ui(1, eyes_open_ == 1 ? 3u : 1u << eye);
  glUniform1i(2, options_.skips.frustum ? 1 : 0);
  glUniform1i(3, DepthPyramid::kMostLevels);
  dispatch_items(stretches(), 64);
}

}  // namespace stipple
