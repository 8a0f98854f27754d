// Smallest and largest values and histograms of attributes, gathered a batch at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/store/potree2/format.h"

namespace stipple {

class AttributeStats {
 public:
  explicit AttributeStats(const Schema& schema);

  // All values of a column, which is of attribute `index` of the schema. NaN counts for nothing.
  void add(std::size_t index, const Column& column);
  void add(const AttributeStats& other);  // of the same schema

  // One range an attribute; zeros where no value was added.
  std::vector<potree2::AttributeRange> ranges() const;

 private:
  using Histogram = std::array<std::uint64_t, 256>;
  struct Extremes {
    std::vector<double> min, max;  // as stored, a value a component
    Histogram histogram{};         // of u8 alone
  };

  Schema schema_;
  std::vector<Extremes> extremes_;
};

}  // namespace stipple
