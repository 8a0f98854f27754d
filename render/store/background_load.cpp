#include "render/store/background_load.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "octree/core/stopwatch.h"

namespace stipple {
namespace {

// Nobody wants the rest.
struct Stopped {};

}  // namespace

BackgroundLoad::BackgroundLoad(const PointSource& source, ColorChoice color)
    : source_(source), color_(std::move(color)), total_(static_cast<std::size_t>(source.info().point_count)) {}

BackgroundLoad::~BackgroundLoad() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void BackgroundLoad::start() {
  thread_ = std::thread([this] {
    try {
      read();
    } catch (const Stopped&) {
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    changed_.notify_all();
  });
}

void BackgroundLoad::read() {
  const Stopwatch watch;
  const ColorMap unstretched = color_.complete({.attribute = color_.attribute});
  load_cloud(source_, attribute_names_of(unstretched, source_.info().schema), cloud_,
             [this](std::uint64_t first, std::size_t count) { arrived(first, count); });
  auto dataset = std::make_shared<Dataset>();
  dataset->info = cloud_.info;
  dataset->colors = color_.complete(map_colors(cloud_, color_.attribute));
  dataset->points = make_point_set(cloud_, dataset->colors);
  dataset->load_seconds = watch.seconds();
  const std::lock_guard lock(mutex_);
  whole_ = std::move(dataset);
}

void BackgroundLoad::arrived(std::uint64_t first, std::size_t count) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !paused_ || stop_; });
    if (stop_) throw Stopped();
    ranges_.push_back({first, count});
    ready_ += count;
  }
  changed_.notify_all();
}

void BackgroundLoad::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ranges_.empty() || whole_ || failure_; });
}

void BackgroundLoad::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
}

void BackgroundLoad::resume() {
  {
    const std::lock_guard lock(mutex_);
    paused_ = false;
  }
  changed_.notify_all();
}

std::size_t BackgroundLoad::ready() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return ready_;
}

// Stretched over these points.
void BackgroundLoad::choose_colors(const Range& range) {
  Cloud some;
  some.info = cloud_.info;
  const auto first = cloud_.positions.begin() + static_cast<std::ptrdiff_t>(range.first);
  some.positions.assign(first, first + static_cast<std::ptrdiff_t>(range.count));
  for (const Column& column : cloud_.columns) {
    const std::size_t stride = column.attribute.bytes();
    Column& copy = some.columns.emplace_back(Column{column.attribute, {}});
    copy.resize(range.count);
    std::memcpy(copy.bytes.data(), column.bytes.data() + range.first * stride, copy.bytes.size());
  }
  colors_ = color_.complete(map_colors(some, color_.attribute));
}

PointArrivals::Batch BackgroundLoad::take(std::size_t most) {
  Range taken{0, 0};
  {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (ranges_.empty()) return {};
    Range& front = ranges_.front();
    taken = {front.first, std::min(front.count, most)};
    front.first += taken.count;
    front.count -= taken.count;
    ready_ -= taken.count;
    if (front.count == 0) ranges_.pop_front();
  }
  if (taken.count == 0) return {};
  if (!colors_) choose_colors(taken);
  packed_.resize(taken.count);
  pack_points(*colors_, cloud_.positions, cloud_.columns, static_cast<std::size_t>(taken.first), packed_);
  return {static_cast<std::uint32_t>(taken.first), packed_};
}

std::shared_ptr<const Dataset> BackgroundLoad::whole() {
  const std::lock_guard lock(mutex_);
  if (!whole_ || !ranges_.empty()) return nullptr;
  cloud_ = {};
  return whole_;
}

}  // namespace stipple
