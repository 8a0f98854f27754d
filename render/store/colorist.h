// Other colours for points that are in memory. Source: S19, section 4 (attributes streamed on demand).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "render/store/colorize.h"
#include "render/store/dataset.h"

namespace stipple {

// Main memory while a cloud gets other colours, a point: it is there twice, and so are colours and values.
inline constexpr std::uint64_t kBytesPerPointOfColors = 2 * 20 + 4 + 8;

// Finds the colours of a cloud whose points have ids 0, 1, ... in any order. Keeps the values that they were made from
// last, and the classes, 1 byte a point in LAS: another ramp, or other classes to hide, then need no file.
class Colorist {
 public:
  // Element i of each of these attributes is that of the point with id i.
  using Read = std::function<std::vector<Column>(const std::vector<std::string>& attributes)>;

  struct Colors {
    ColorMap map;
    Buffer<std::uint32_t> by_id;  // PackedPoint::rgba
  };

  // As load_dataset() would colour them by `choice`, whose attribute is as choose_color() gives it. Reads what it
  // lacks, of heights nothing. Throws Error for points with other ids.
  Colors color(const Dataset& dataset, const ColorChoice& choice, const Read& read);

 private:
  const Column* find(const std::string& attribute) const;
  void keep(Column column);
  void fetch(const std::vector<std::string>& wanted, const Read& read);

  std::optional<Column> values_;  // of the attribute asked for last, by id
  std::optional<Column> classes_;
};

// The same points with these colours.
Dataset recolored(const Dataset& dataset, const Colorist::Colors& colors);

}  // namespace stipple
