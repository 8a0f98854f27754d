// Choosing among surfaces in proportion to their areas.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace stipple::scene {

class AreaTable {
 public:
  // Appends surface number size().
  void add(double area) { ends_.push_back(total() + area); }

  std::size_t size() const { return ends_.size(); }
  double total() const { return ends_.empty() ? 0.0 : ends_.back(); }

  // The surface that covers `place`, in [0, 1], of the areas laid end to end. Needs at least one surface.
  std::size_t pick(double place) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), place * total());
    return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
  }

 private:
  std::vector<double> ends_;  // running sums
};

}  // namespace stipple::scene
