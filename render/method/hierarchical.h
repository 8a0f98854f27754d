// T16: Tredinnick, Broecker, Ponto 2016, "Progressive Feedback Point Cloud Rendering for Virtual Reality Display".
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "render/method/method.h"
#include "render/store/point_supply.h"
#include "render/store/stream_buffer.h"

namespace stipple {

// The points stay in main memory or on disk. For each view the visible clusters are put in order, front to back; then
// rounds: every cluster streams as many points as it is estimated to cover pixels, in the next round as many again,
// then twice that, until nothing is left. Each frame refills a section of one vertex buffer and carries the last frame
// as a grid of points, one a pixel. Within a cluster the points are shuffled, so that what a round reads is an even
// sample.
class Hierarchical final : public Method {
 public:
  // Budgets above `largest_budget` (or StreamBuffer::kLargestSection) are cut.
  Hierarchical(std::unique_ptr<PointSupply> supply, std::uint32_t largest_budget);

  Carry carry() const override { return Carry::grid; }
  void set_point_size(const PointSize& point_size) override;
  void start_view(const View& view) override;
  Selection select(std::uint32_t budget) override;
  bool finished() const override {
    return to_request_ == 0 && supply_->points_under_way() == 0 && !supply_->searching();
  }
  SelectionCounts counts() const override;
  Unread unread() const override { return supply_->unread(); }
  std::vector<SightedBox> boxes() const override;
  bool recolor(const ColorUpload&, const PointSet& points) override { return supply_->recolor(points); }

 private:
  struct Reading {
    std::uint32_t handle;
    std::uint32_t count;      // points of the cluster
    std::uint32_t requested;  // of them for this view
    std::uint32_t allowed;    // of them to be requested by the end of this round
    double distance;          // from the eye
    bool one_pixel;           // see PointRange
  };

  void append(const std::vector<VisibleCluster>& clusters);
  void take_discovered();
  void request_ahead(std::uint64_t points);
  void next_round();

  std::unique_ptr<PointSupply> supply_;
  StreamBuffer stream_;
  PointSize point_size_;
  SelectionCounts counts_;           // of this view's clusters
  std::vector<Reading> readings_;    // front to back
  std::vector<std::uint32_t> done_;  // handles of clusters whose points are all requested
  std::size_t next_ = 0;             // reading to go on with in this round
  std::uint64_t to_request_ = 0;     // points not requested yet for this view
};

}  // namespace stipple
