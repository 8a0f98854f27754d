// Work on all cores whose results are taken in order.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace stipple {

// Items 0 to count - 1: made on any thread, given to `place` one after the other in that order, then to `finish` on any
// thread. At most `in_flight` items exist at once. What one of the three throws ends it all and is thrown here.
//
//   make(std::size_t index) -> std::unique_ptr<Item>, place(Item&), finish(Item&)
//
// Not tbb::parallel_pipeline, which would do: the thread sanitizer does not see into libtbb how a pipeline hands an
// item from thread to thread, and takes each for a race.
template <class Item, class Make, class Place, class Finish>
class InOrder {
 public:
  InOrder(std::size_t count, std::size_t in_flight, const Make& make, const Place& place, const Finish& finish)
      : count_(count), in_flight_(in_flight), make_(make), place_(place), finish_(finish) {}

  void run() {
    tbb::parallel_for(
        0, tbb::this_task_arena::max_concurrency(), [this](int) { work(); }, tbb::simple_partitioner{});
  }

 private:
  using Items = std::vector<std::unique_ptr<Item>>;

  void work() try {
    std::size_t index = 0;
    while (take(index)) {
      Items placed = place_ready(index, make_(index));
      for (const auto& item : placed) finish_(*item);
      const std::size_t finished = placed.size();
      placed.clear();
      const std::lock_guard lock(mutex_);
      finished_ += finished;
      changed_.notify_all();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    changed_.notify_all();
    throw;
  }

  // Waits for room. Whoever has an item is at work on it, so room will come.
  bool take(std::size_t& index) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failed_ || taken_ == count_ || taken_ - finished_ < in_flight_; });
    if (failed_ || taken_ == count_) return false;
    index = taken_++;
    return true;
  }

  // Places the item, and those that waited for it, unless another thread is placing: then that one will.
  Items place_ready(std::size_t index, std::unique_ptr<Item> item) {
    Items placed;
    std::unique_lock lock(mutex_);
    ready_.emplace(index, std::move(item));
    if (placing_) return placed;
    placing_ = true;
    while (!ready_.empty() && ready_.begin()->first == placed_ && !failed_) {
      placed.push_back(std::move(ready_.extract(ready_.begin()).mapped()));
      lock.unlock();
      place_(*placed.back());
      lock.lock();
      ++placed_;
    }
    placing_ = false;
    return placed;
  }

  std::size_t count_, in_flight_;
  const Make& make_;
  const Place& place_;
  const Finish& finish_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t taken_ = 0, placed_ = 0, finished_ = 0;
  std::map<std::size_t, std::unique_ptr<Item>> ready_;  // made, not yet placed
  bool placing_ = false;                                // a thread is at it, without the lock
  bool failed_ = false;
};

template <class Item, class Make, class Place, class Finish>
void in_order(std::size_t count, std::size_t in_flight, const Make& make, const Place& place, const Finish& finish) {
  InOrder<Item, Make, Place, Finish>(count, in_flight, make, place, finish).run();
}

}  // namespace stipple
