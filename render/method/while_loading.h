// Drawing a cloud while it is being read.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "render/method/arriving.h"
#include "render/method/progressive_renderer.h"
#include "render/store/cluster_cut.h"
#include "render/store/point_arrivals.h"

namespace stipple {

// The modes that can.
bool draws_while_loading(Mode mode);

// Mode unstructured draws what has arrived: as S19 in the slots of the final shuffle, as S18 displaced. Mode hybrid
// begins so, too, displaced but carried as vertices; when all points are there and cut into clusters, it goes on with
// those from the picture that is there. Both end exact, colours included: where the colours of the whole cloud are
// others than those that the points came in, these are sent again, 4 bytes a point.
class WhileLoading {
 public:
  struct Options {
    MethodOptions method;
    std::size_t most_arrivals = std::size_t{1} << 20;  // points a frame
    // Hybrid: clusters are cut between two frames, and not beside them for as long as it takes.
    bool cut_at_once = false;
  };
  // `arrivals` must outlive it. `mode` must be one that can. Throws Error when memory is refused, by the limits or the
  // driver.
  WhileLoading(PointArrivals& arrivals, Mode mode, const Options& options);

  // What the renderer that advance() gets begins with.
  Method& method() { return *arriving_; }
  // Before each frame: takes what has arrived, and gives the renderer another method when it is time. Throws what the
  // reading has thrown.
  void advance(ProgressiveRenderer& renderer);

  // Without another arrival the next frame of a view shows nothing new.
  bool idle() const { return !whole_ && arriving_->idle(); }
  // All points are there in their final colours: null before.
  const std::shared_ptr<const Dataset>& whole() const { return whole_; }
  std::size_t points_loaded() const { return points_loaded_; }
  bool by_clusters() const { return hybrid_ != nullptr; }
  // To the GPU for the points that arrived; 0 before any has.
  std::uint64_t bytes_uploaded() const { return bytes_uploaded_; }
  // Of it, colours alone.
  std::uint64_t color_bytes_uploaded() const { return color_bytes_uploaded_; }
  SelectionCounts counts() const { return hybrid_ ? hybrid_->counts() : SelectionCounts{}; }

 private:
  void take_points();
  void finish_colors(ProgressiveRenderer& renderer);
  void switch_to_clusters(ProgressiveRenderer& renderer);

  PointArrivals& arrivals_;
  Mode mode_;
  Options options_;
  std::unique_ptr<Arriving> arriving_;  // null once hybrid draws by clusters
  std::shared_ptr<const Dataset> whole_;
  std::future<ClusterCut> cut_;
  std::unique_ptr<Method> hybrid_;
  std::size_t points_loaded_ = 0;
  std::uint64_t bytes_uploaded_ = 0;
  std::uint64_t color_bytes_uploaded_ = 0;
};

}  // namespace stipple
