// A tree on disk for mode hybrid: what a view needs of it comes to a pool on the GPU, and what it needs no more goes.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "render/method/cluster_source.h"
#include "render/store/cluster_pool.h"
#include "render/store/part_reader.h"
#include "render/store/tree_supply.h"

namespace stipple {

// The parts of nodes in sight are read by urgency: those whose points are farthest apart on the screen first (T15), so
// that a coarse picture of everything is there early. Parts wholly behind what is drawn are not read. When the pool is
// full, parts out of sight give way, then those whose points are all drawn or hidden, least urgent first: the picture
// carries what they had to show. So any pool shows the whole view in the end.
//
// A view does without what cannot be read.
class TreeClusters final : public ClusterSource {
 public:
  struct Options {
    std::uint32_t slots = 0;         // of the pool
    std::uint64_t points_ahead = 0;  // in main memory on their way to the pool, in parts of kLargestPart points
    bool all_attributes = false;     // see DatasetNeeds
  };
  // Points of a part at most, where the tree is read in parts.
  static constexpr std::uint32_t kLargestPart = 32'768;

  // `bytes_before`: see TreeSupply.
  TreeClusters(std::shared_ptr<const TreeStore> store, const ColorMap& colors, std::uint64_t bytes_before,
               const Options& options);

  const ClusterTable& table() const override { return pool_.table(); }
  void start_view(const View& view) override;
  void load(std::uint32_t budget, ClusterSelector& selector) override;
  bool finished() const override;
  Unread unread() const override;
  void count(SelectionCounts& counts) const override;

 private:
  using Key = PartKey;

  // A part in sight that is not on the GPU.
  struct Wanted {
    Key key;
    double urgency;  // TreeSupply::projected_spacing()
    std::uint32_t count;
    GridBox box;
  };
  // Read, and waiting for room.
  struct Arrival {
    Key key;
    SlottedPoints points;
    std::uint32_t count = 0;     // points
    std::uint32_t uploaded = 0;  // slots
  };
  // On the GPU.
  struct Resident {
    std::vector<ClusterRun> runs;
    std::uint64_t view = 0;  // the latest to want it
    double urgency = 0.0;    // then
    bool whole = true;       // all of the part
  };

  void want(const std::vector<VisibleCluster>& clusters);
  void want(Key key, const TreeSupply::Part& part, std::uint32_t count, double urgency);
  void request(std::uint64_t points, ClusterSelector& selector);
  void receive(bool patient);
  void upload(std::uint64_t points, ClusterSelector& selector);
  void make_room(std::uint32_t slots, ClusterSelector& selector);
  std::vector<Key> finished_parts(const ClusterSelector& selector) const;
  void drop(Key key, ClusterSelector& selector);

  std::shared_ptr<const TreeStore> store_;
  TreeSupply supply_;
  PartReader reader_;
  ClusterPool pool_;
  std::uint64_t points_ahead_;
  std::uint64_t view_number_ = 0;
  std::vector<Wanted> wanted_;               // of this view, the most urgent first
  std::size_t next_ = 0;                     // of them to be requested
  std::unordered_map<Key, double> loading_;  // requested, or arrived; urgency, in this view or the last to want it
  Unread unread_;                            // parts
  std::deque<Arrival> arrivals_;
  std::uint64_t arrived_points_ = 0;
  std::uint64_t points_read_ = 0;  // ever
  std::unordered_map<Key, Resident> residents_;
};

}  // namespace stipple
