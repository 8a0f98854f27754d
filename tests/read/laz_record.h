// Where the items of a LAZ record stand, for what tests write.
#pragma once

#include <initializer_list>
#include <utility>

#include "tests/octree/las_fixture.h"

namespace stipple::test {

// Byte offsets from the start of a record; 0: the point format has no such item.
struct RecordPlaces {
  std::size_t time = 0, rgb = 0, nir = 0, wave = 0;
  std::size_t extra = 0;  // where extra bytes begin, or would
  std::size_t length = 0;

  explicit RecordPlaces(const LasFile& las) : length(las.record_length()) {
    const int format = las.format;
    extra = format < 6 ? 20 : 22;
    const auto take = [&](std::size_t& place, std::size_t bytes, std::initializer_list<int> formats) {
      if (std::ranges::find(formats, format) != formats.end()) place = std::exchange(extra, extra + bytes);
    };
    take(time, 8, {1, 3, 4, 5, 6, 7, 8, 9, 10});
    take(rgb, 6, {2, 3, 5, 7, 8, 10});
    take(nir, 2, {8, 10});
    take(wave, 29, {4, 5, 9, 10});
  }
  std::size_t extra_bytes() const { return length - extra; }
};

}  // namespace stipple::test
