// Reads a cloud in the background and hands over what has been read.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "octree/cloud/cloud.h"
#include "render/store/point_arrivals.h"

namespace stipple {

// Until all points are there, colours that stretch over the points' values (map_colors()) stretch over those of the
// first batch. But for start(), take() and whole() functions may be called at any time; all by one thread.
class BackgroundLoad final : public PointArrivals {
 public:
  // `source` must outlive it; the attribute as choose_color() gives it.
  BackgroundLoad(const PointSource& source, ColorChoice color);
  // Ends the reading.
  ~BackgroundLoad() override;
  BackgroundLoad(const BackgroundLoad&) = delete;
  BackgroundLoad& operator=(const BackgroundLoad&) = delete;

  // Begins to read, on all cores. Once.
  void start();
  // Returns when there are points to take, or the whole cloud, or an error for take() to throw.
  void wait();
  // Between these nothing more is handed over, and reading soon stands still.
  void pause();
  void resume();

  std::size_t total() const override { return total_; }
  std::size_t ready() override;
  Batch take(std::size_t most) override;
  std::shared_ptr<const Dataset> whole() override;
  const ColorMap& colors() const override { return *colors_; }

 private:
  struct Range {
    std::uint64_t first;
    std::size_t count;
  };
  void read();
  void arrived(std::uint64_t first, std::size_t count);
  void choose_colors(const Range& range);

  const PointSource& source_;
  ColorChoice color_;
  std::size_t total_;
  std::optional<ColorMap> colors_;
  Buffer<PackedPoint> packed_;  // what take() gave
  std::thread thread_;

  Cloud cloud_;       // what ranges_ say is there, anyone may read
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Range> ranges_;  // there, and not taken
  std::size_t ready_ = 0;     // points of these
  std::shared_ptr<const Dataset> whole_;
  std::exception_ptr failure_;
  bool paused_ = false;
  bool stop_ = false;
};

}  // namespace stipple
