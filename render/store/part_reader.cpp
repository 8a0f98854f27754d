#include "render/store/part_reader.h"

#include <algorithm>
#include <utility>

#include "render/store/disk_reads.h"
#include "render/store/tree_ids.h"
#include "render/store/unread.h"

namespace stipple {

PartReader::PartReader(std::shared_ptr<const TreeStore> store, ColorMap colors, double root_edge, bool all_attributes)
    : store_(std::move(store)), colors_(std::move(colors)), root_edge_(root_edge) {
  const Schema& schema = store_->info().source.schema;
  attributes_ = attributes_of(colors_, schema);
  for (std::size_t i = 0; all_attributes && i < schema.size(); ++i)
    if (std::ranges::find(attributes_, i) == attributes_.end()) attributes_.push_back(i);
  for (std::size_t i = 0; i < kReadThreads; ++i) threads_.emplace_back([this] { work(); });
}

PartReader::~PartReader() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void PartReader::request(Request request) {
  points_under_way_ += request.count;
  const std::lock_guard lock(mutex_);
  queue_.push_back(std::move(request));
  work_ready_.notify_one();
}

std::vector<PartReader::Request> PartReader::cancel() {
  const std::lock_guard lock(mutex_);
  std::vector<Request> cancelled(queue_.begin(), queue_.end());
  queue_.clear();
  for (const Request& request : cancelled) points_under_way_ -= request.count;
  return cancelled;
}

std::vector<PartReader::Part> PartReader::collect(bool patient) {
  std::vector<Part> parts;
  std::unique_lock lock(mutex_);
  if (patient && points_under_way_ > 0) arrived_.wait_for(lock, kReadPatience, [this] { return !parts_.empty(); });
  parts.swap(parts_);
  for (const Part& part : parts) points_under_way_ -= part.request.count;
  return parts;
}

void PartReader::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_ready_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    Part part{std::move(queue_.front()), {}};
    queue_.pop_front();
    lock.unlock();
    try {
      part.points = read(part.request);
    } catch (...) {
      part.failure = std::current_exception();
    }
    lock.lock();
    if (part.failure && ++part.request.tries < kReadTries) {
      queue_.push_back(std::move(part.request));
      continue;
    }
    parts_.push_back(std::move(part));
    arrived_.notify_one();
  }
}

SlottedPoints PartReader::read(const Request& request) const {
  PointBatch batch;
  store_->read_part(request.node, request.first, request.count, attributes_, batch);
  Buffer<PackedPoint> points(batch.positions.size());
  pack_points(colors_, batch.positions, batch.columns, 0, points);
  return slotted(store_->info().source.grid, points, first_id_of(request.node) + request.first, root_edge_);
}

}  // namespace stipple
