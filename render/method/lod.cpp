#include "render/method/lod.h"

#include <algorithm>

namespace stipple {

void Lod::start_view(const View& view) {
  parts_ = source_->visible(view);
  sort();
  finished_ = false;
}

SelectionCounts Lod::counts() const {
  SelectionCounts counts{.nodes_visible = parts_.size(), .bytes_read = source_->bytes_read()};
  if (with_splats_)
    for (const LodSource::Part& part : parts_) count_splats(part.splats, counts);
  return counts;
}

void Lod::sort() {
  std::ranges::sort(parts_, [](const LodSource::Part& a, const LodSource::Part& b) {
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.key < b.key;
  });
}

std::size_t Lod::chosen(std::uint32_t budget) const {
  std::uint64_t points = 0, slots = 0;
  std::size_t parts = 0;
  for (; parts < parts_.size(); ++parts) {
    points += parts_[parts].count;
    slots += SlottedPoints::slots_for(parts_[parts].count);
    if (points > budget || slots > source_->room()) break;
  }
  return parts;
}

Selection Lod::select(std::uint32_t budget) {
  Selection selection;
  const std::vector<LodSource::Part> discovered = source_->discovered();
  if (!discovered.empty()) {
    parts_.insert(parts_.end(), discovered.begin(), discovered.end());
    sort();
  }
  const bool all = source_->draw(std::span(parts_).first(chosen(budget)), selection);
  finished_ = all && !source_->searching();
  return selection;
}

}  // namespace stipple
