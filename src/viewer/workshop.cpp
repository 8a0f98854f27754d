#include "src/viewer/workshop.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "octree/cloud/cloud.h"
#include "octree/cloud/columns.h"
#include "octree/core/error.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "render/frame/propose_views.h"
#include "render/store/tree_ids.h"
#include "src/viewer/describe_point.h"

namespace stipple {
namespace {

using Phase = WorkStatus::Phase;

void check_room(const SourceInfo& info, std::uint64_t bytes_per_point, const MemoryLimits& limits) {
  const std::uint64_t bytes = info.point_count * bytes_per_point;
  if (bytes <= limits.main) return;
  throw Error(fmt::format(
      "{}: its {} points would take about {:.1f} GB of memory, and {:.1f} are free. Build an octree (stipple "
      "build) and open that: mode hybrid draws it from disk.",
      info.path, info.point_count, static_cast<double>(bytes) * 1e-9, static_cast<double>(limits.main) * 1e-9));
}

// What is read of it now would not belong to the points that were read before.
void check_same(const SourceInfo& then, const SourceInfo& now) {
  const bool same = then.point_count == now.point_count && then.grid.offset == now.grid.offset &&
                    then.grid.scale == now.grid.scale && then.schema == now.schema &&
                    then.stated_bounds.min == now.stated_bounds.min && then.stated_bounds.max == now.stated_bounds.max;
  if (!same)
    throw Error(fmt::format("{}: is not the cloud any more that it was when it was opened. Open it again.", now.path));
}

// What is wrong with it, if it throws; `purpose`: what memory was asked for.
std::optional<finished::Failure> failure_of(const std::function<void()>& task, const std::string& purpose) {
  try {
    task();
    return std::nullopt;
  } catch (const Cancelled&) {
    return finished::Failure{.message = {}, .mode = {}, .cancelled = true};
  } catch (const std::bad_alloc&) {
    return finished::Failure{.message = fmt::format("there is too little memory for {}", purpose), .mode = {}};
  } catch (const std::exception& e) {
    return finished::Failure{.message = e.what(), .mode = {}};
  }
}

}  // namespace

Workshop::Workshop(const Window& window) : context_(window), thread_([this] { work(); }) {}

Workshop::~Workshop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    watch_.stop = true;
    tasks_.clear();
  }
  wake_.notify_one();
  thread_.join();
}

void Workshop::open(const Opening& opening) {
  {
    const std::lock_guard lock(mutex_);
    ++asked_;
    watch_.stop = true;
    tasks_.clear();
    color_.reset();
    finished_.clear();
  }
  add([this, opening] {
    opening_ = opening;
    dataset_.reset();
    colorist_ = {};
    open_now();
  });
}

void Workshop::recolor(const ColorChoice& color) {
  {
    const std::lock_guard lock(mutex_);
    if (recoloring_) watch_.stop = true;
    if (std::exchange(color_, color)) return;
  }
  add([this] { recolor_now(); });
}

void Workshop::make(Mode mode) {
  add([this, mode] { make_now(mode); });
}

void Workshop::describe(std::uint32_t id, const glm::ivec3& position) {
  add([this, id, position] { describe_now(id, position); });
}

void Workshop::cancel() {
  const std::lock_guard lock(mutex_);
  watch_.stop = true;
  tasks_.clear();
  if (std::exchange(color_, std::nullopt) && !recoloring_)
    finished_.push_back(finished::Failure{.message = {}, .mode = {}, .cancelled = true, .recoloring = true});
}

bool Workshop::will_recolor() const {
  const std::lock_guard lock(mutex_);
  return color_.has_value();
}

void Workshop::add(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
}

WorkStatus Workshop::status() const {
  const std::lock_guard lock(mutex_);
  WorkStatus status{.phase = phase_};
  if (phase_ == Phase::idle) {
    if (!tasks_.empty() || !finished_.empty()) status.phase = Phase::opening;
    return status;
  }
  status.seconds = phase_watch_.seconds();
  if (phase_ == Phase::reading) {
    status.points = watch_.points;
    status.total = watch_.total;
  }
  return status;
}

std::vector<Finished> Workshop::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, {});
}

void Workshop::begin(Phase phase) {
  const std::lock_guard lock(mutex_);
  phase_ = phase;
  phase_watch_ = {};
}

void Workshop::deliver(Finished finished) {
  {
    const std::lock_guard lock(mutex_);
    if (working_ != asked_) return;
    finished_.push_back(std::move(finished));
  }
  Window::wake();
}

void Workshop::deliver_cloud(std::shared_ptr<const Dataset> dataset) {
  dataset_ = std::move(dataset);
  const PointSet& points = dataset_->overview();
  deliver(finished::Cloud{dataset_, robust_bounds(points), propose_cameras(points, opening_.aspect).front().camera});
}

void Workshop::work() {
  context_.make_current();
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !tasks_.empty(); });
    if (stop_) break;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    working_ = asked_;
    watch_.stop = false;
    lock.unlock();
    run(task);
    begin(Phase::idle);
    Window::wake();
    lock.lock();
  }
  lock.unlock();
  context_.release();
}

void Workshop::run(const Task& task) {
  if (auto failure = failure_of(task, "this cloud")) deliver(std::move(*failure));
}

void Workshop::open_now() {
  begin(Phase::opening);
  if (opening_.inputs.size() == 1 && is_tree(opening_.inputs.front()))
    open_octree();
  else
    open_files();
  make_now(opening_.mode);
}

void Workshop::open_files() {
  const auto source = open_source(opening_.inputs);
  const SourceInfo& info = source->info();
  ColorChoice color = opening_.color;
  color.attribute = choose_color(info.schema, color.attribute);
  check_room(info, kBytesPerPoint, opening_.method.limits);
  deliver(finished::Beginning{info});
  const WatchedSource watched(*source, watch_, color,
                              [this](PreviewPoints points) { deliver(finished::Preview{std::move(points)}); });
  begin(Phase::reading);
  deliver_cloud(
      std::make_shared<Dataset>(load_dataset(watched, color, needs_of(opening_.mode, opening_.method.skips))));
}

void Workshop::open_octree() {
  deliver_cloud(std::make_shared<Dataset>(
      open_dataset(opening_.inputs, opening_.color, {.points = false, .octree = true}, opening_.method.limits)));
  // The first picture comes from disk, whatever it is to be drawn by when all points are there
  if (needs_of(opening_.mode, opening_.method.skips).points) make_now(Mode::hybrid);
}

void Workshop::read_all_points() {
  begin(Phase::opening);
  const TreeSource source(dataset_->tree);
  check_room(source.info(), kBytesPerPoint, opening_.method.limits);
  const WatchedSource watched(source, watch_, {}, {});
  begin(Phase::reading);
  Dataset whole;
  whole.info = source.info();
  whole.colors = dataset_->colors;
  whole.tree = dataset_->tree;
  whole.root = dataset_->root;
  whole.points = make_point_set(load_cloud(watched, attribute_names_of(whole.colors, whole.info.schema)), whole.colors);
  whole.points.ids = ids_of(source.nodes());
  whole.bytes_to_load = whole.tree->bytes_read();
  deliver_cloud(std::make_shared<Dataset>(std::move(whole)));
}

void Workshop::recolor_now() {
  ColorChoice color;
  {
    const std::lock_guard lock(mutex_);
    color = *std::exchange(color_, std::nullopt);
    recoloring_ = true;
  }
  auto failure = failure_of([&] { change_colors(std::move(color)); }, "other colours");
  {
    const std::lock_guard lock(mutex_);
    recoloring_ = false;
    // What was stopped for other colours has not failed
    if (failure && failure->cancelled && color_) failure.reset();
  }
  if (!failure) return;
  failure->recoloring = true;
  deliver(std::move(*failure));
}

void Workshop::change_colors(ColorChoice color) {
  begin(Phase::coloring);
  color.attribute = choose_color(dataset_->info.schema, color.attribute);
  check_room(dataset_->info, kBytesPerPointOfColors, opening_.method.limits);
  const Colorist::Colors colors = colorist_.color(
      *dataset_, color, [this](const std::vector<std::string>& attributes) { return read_columns(attributes); });
  auto other = std::make_shared<Dataset>(recolored(*dataset_, colors));
  auto upload = std::make_unique<ColorUpload>(colors.by_id);
  // The window's context is to see what was uploaded
  glFinish();
  dataset_ = std::move(other);
  deliver(finished::Colors{dataset_, std::move(upload)});
}

std::vector<Column> Workshop::read_columns(const std::vector<std::string>& attributes) {
  const auto source = open_source(opening_.inputs);
  check_same(dataset_->info, source->info());
  const WatchedSource watched(*source, watch_, {}, {});
  begin(Phase::reading);
  std::vector<Column> columns = load_columns(watched, attributes);
  begin(Phase::coloring);
  return columns;
}

void Workshop::make_now(Mode mode) {
  auto failure = failure_of([&] { make_method_now(mode); }, fmt::format("mode {}", name_of(mode)));
  if (!failure) return;
  failure->mode = mode;
  deliver(std::move(*failure));
}

void Workshop::make_method_now(Mode mode) {
  if (!dataset_) throw Error("the cloud could not be read; open it again");
  const DatasetNeeds needs = needs_of(mode, opening_.method.skips);
  if (needs.points && !dataset_->in_memory()) read_all_points();
  if (needs.octree && !dataset_->tree && !dataset_->octree) {
    begin(Phase::sorting);
    check_room(dataset_->info, kBytesPerPointOfOctree, opening_.method.limits);
    auto ordered = std::make_shared<Dataset>(*dataset_);
    add_octree(*ordered);
    deliver_cloud(ordered);
  }
  begin(Phase::preparing);
  auto method = make_method(mode, *dataset_, opening_.method);
  // The window's context is to see what was uploaded
  glFinish();
  deliver(finished::MadeMethod{mode, dataset_, std::move(method)});
}

void Workshop::describe_now(std::uint32_t id, const glm::ivec3& position) {
  if (!dataset_) return;
  PointValues values;
  try {
    values = dataset_->tree ? describe_point(*dataset_->tree, id, position)
                            : describe_point(*open_source(opening_.inputs), id);
    if (dataset_->octree) values.insert(values.begin(), {"node", node_of(*dataset_->octree, id)});
  } catch (const Error& e) {
    values = {{"", e.what()}};
  }
  deliver(finished::Description{id, std::move(values)});
}

}  // namespace stipple
