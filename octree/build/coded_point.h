// What the stages of building pass on of a point: where it is, who it is, and its lot.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>

#include "octree/build/morton.h"
#include "octree/build/positions.h"

namespace stipple {

struct CodedPoint {    // no initialisers: buffers of these are filled by all cores at once
  std::uint64_t code;  // Morton code of its finest cell
  std::uint32_t id;    // index in the source
  std::uint32_t rank;  // random, no two points share one: see Ranking
};

// Ascending order of code; equal codes in random order. Total, so that sorting undoes any order of arrival.
inline bool operator<(const CodedPoint& a, const CodedPoint& b) {
  return std::tie(a.code, a.rank) < std::tie(b.code, b.rank);
}

// A random permutation of all 32-bit ids, given by its seed.
class Ranking {
 public:
  explicit Ranking(std::uint64_t seed);
  std::uint32_t operator()(std::uint32_t id) const;

 private:
  std::uint32_t flip_;
  std::uint32_t shift_;
};

// Codes positions [first, first + coded.size()), ids being indices in `positions`. Throws Error when a position is
// outside `bounds`.
void code_points(const PositionView& positions, std::size_t first, const GridBox& bounds, const Quantizer& quantizer,
                 const Ranking& ranking, std::span<CodedPoint> coded);

}  // namespace stipple
