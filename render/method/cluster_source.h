// Where mode hybrid gets its clusters from.
#pragma once

#include <cstdint>

#include "render/frame/camera.h"
#include "render/method/cluster_selector.h"
#include "render/method/method.h"
#include "render/store/cluster_table.h"

namespace stipple {

class ClusterSource {
 public:
  virtual ~ClusterSource() = default;

  // Of what is on the GPU. Stays where it is, and may grow to its capacity.
  virtual const ClusterTable& table() const = 0;
  virtual void start_view(const View& view) = 0;
  // Before a frame of `budget` points is selected: brings clusters to the GPU and makes them known to the selector.
  virtual void load(std::uint32_t budget, ClusterSelector& selector) = 0;
  // Nothing that this view may need is missing from the GPU, or was and is drawn.
  virtual bool finished() const = 0;
  // Adds what it knows.
  virtual void count(SelectionCounts& counts) const = 0;
  // See Method::unread().
  virtual Unread unread() const { return {}; }
  // See Method::colored().
  virtual std::optional<std::vector<ColoredPoints>> colored() const { return std::nullopt; }
};

// All of them, always.
class WholeCloud final : public ClusterSource {
 public:
  explicit WholeCloud(ClusterTable table) : table_(std::move(table)) {}

  const ClusterTable& table() const override { return table_; }
  void start_view(const View&) override {}
  void load(std::uint32_t, ClusterSelector&) override {}
  bool finished() const override { return true; }
  void count(SelectionCounts&) const override {}
  std::optional<std::vector<ColoredPoints>> colored() const override {
    std::vector<ColoredPoints> colored;
    for (const ClusterTable::Chunk& chunk : table_.chunks) colored.push_back({&chunk.points, &chunk.ids});
    return colored;
  }

 private:
  ClusterTable table_;
};

}  // namespace stipple
