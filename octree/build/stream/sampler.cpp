#include "octree/build/stream/sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "octree/build/sampling.h"

namespace stipple {
namespace {

// Bins are two spacings wide: all darts within one spacing of a place are in its own bin and in the seven on the sides
// of its nearest corner.
constexpr int kBinsAlong = (1 << kLatticeLevels) / 2;
constexpr std::uint32_t kNoDarts = 0;
constexpr float kFarAway = 1e9f;

// Places are floats below 128, each up to 4e-6 off: asking for this much more leaves no pair too close.
constexpr float kLeastSquare = static_cast<float>(kPoissonFraction * kPoissonFraction) * 1.0001f;

// Bins are numbered in Morton order, so that those side by side share cache lines.
constexpr auto kSpread = [] {
  std::array<std::uint32_t, kBinsAlong> spread{};
  for (std::uint32_t i = 0; i < kBinsAlong; ++i) spread[i] = static_cast<std::uint32_t>(spread_bits(i));
  return spread;
}();

// Candidates are thrown in so many sweeps along the Morton curve, each with every so manieth of them: neighbours in a
// sweep are far apart at first, as darts should be, and the memory they touch is not. Powers of two.
constexpr std::uint32_t kSweeps = 16;
// Sweep 0, 8, 4, 12, 2, ...: each in the middle of the widest gap that is left.
constexpr std::array<std::uint32_t, kSweeps> kSweepOrder{0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};

// Parts, along one axis, of the numbers of a place's own bin and the nearer of its neighbours; the same one twice at
// the border of the cell.
struct BinPair {
  std::uint32_t own, other;

  explicit BinPair(float place) {
    const float bin = place * 0.5f;
    const int index = static_cast<int>(bin);
    const int side = bin - static_cast<float>(index) < 0.5f ? -1 : 1;
    own = kSpread[static_cast<std::size_t>(index)];
    other = kSpread[static_cast<std::size_t>(std::clamp(index + side, 0, kBinsAlong - 1))];
  }
};

}  // namespace

double spacing_of_level(const RootCube& cube, int level) {
  return std::ldexp(cube.edge, -(kLatticeLevels + level));
}

void Sampler::select(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
                     Buffer<std::uint8_t>& taken) {
  taken.assign(candidates.size(), 0);
  if (candidates.empty()) return;
  if (sampling_ == Sampling::random)
    select_random(points, candidates, level, taken);
  else
    select_poisson(points, candidates, level, taken);
}

// A cell of the lattice is a run of candidates.
void Sampler::select_random(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
                            std::span<std::uint8_t> taken) const {
  const int shift = bits_below(std::min(level + kLatticeLevels, kMaxLevel));
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const CodedPoint& point = points.coded[candidates[i]];
    const CodedPoint& best = points.coded[candidates[lowest]];
    if (point.code >> shift != best.code >> shift) {
      taken[lowest] = 1;
      lowest = i;
    } else if (point.rank < best.rank) {
      lowest = i;
    }
  }
  taken[lowest] = 1;
}

void Sampler::select_poisson(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
                             std::span<std::uint8_t> taken) {
  if (bins_.empty()) bins_.assign(kBinsAlong * kBinsAlong * kBinsAlong, kNoDarts);
  locate(points, candidates, level);
  const auto count = static_cast<std::uint32_t>(candidates.size());
  quivers_.assign(1, empty_quiver());
  for (const std::uint32_t sweep : kSweepOrder)
    for (std::uint32_t i = sweep; i < count; i += kSweeps) taken[i] = throw_dart(places_[i]);
  for (const std::uint32_t bin : used_bins_) bins_[bin] = kNoDarts;
  used_bins_.clear();
}

Sampler::Quiver Sampler::empty_quiver() {
  Quiver quiver{};
  quiver.x += kFarAway;
  return quiver;
}

void Sampler::locate(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level) {
  const double spacing = spacing_of_level(frame_.cube, level);
  const glm::dvec3 scale = frame_.grid.scale / spacing;
  const std::uint64_t cell = points.coded[candidates.front()].code >> bits_below(level);
  const glm::dvec3 corner = glm::dvec3(morton_decode(cell)) * static_cast<double>(1 << kLatticeLevels);
  const glm::dvec3 origin(frame_.bounds.min);
  constexpr double kEdge = 1 << kLatticeLevels;
  const auto inside = [](double place) {
    return static_cast<float>(std::clamp(place, 0.0, kEdge * (1.0 - 1e-7)));  // the border may round outwards
  };
  places_.resize(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const glm::dvec3 place = (glm::dvec3(points.positions[candidates[i]]) - origin) * scale - corner;
    places_[i] = {inside(place.x), inside(place.y), inside(place.z)};
  }
}

template <std::size_t kBins>
inline bool Sampler::meets_dart(const Place& place, const std::array<std::uint32_t, kBins>& bins) const {
  const Lanes x = Lanes{} + place.x, y = Lanes{} + place.y, z = Lanes{} + place.z;
  Lanes nearest = Lanes{} + kFarAway;
  for (const std::uint32_t bin : bins) {
    std::uint32_t q = bins_[bin];
    do {  // the quiver without darts is looked at like any other: cheaper than a branch that cannot be foreseen
      const Quiver& quiver = quivers_[q];
      const Lanes dx = x - quiver.x, dy = y - quiver.y, dz = z - quiver.z;
      const Lanes square = dx * dx + dy * dy + dz * dz;
      nearest = square < nearest ? square : nearest;
      q = quiver.next;
    } while (q != kNoDarts);
  }
  return std::min(std::min(nearest[0], nearest[1]), std::min(nearest[2], nearest[3])) < kLeastSquare;
}

// Looks into the place's own bin first: that is where most of those that are met are.
bool Sampler::throw_dart(const Place& place) {
  const BinPair x(place.x), y(place.y), z(place.z);
  const std::uint32_t own = x.own << 2 | y.own << 1 | z.own;
  if (meets_dart(place, std::array{own})) return false;
  if (meets_dart(place, std::array{x.other << 2 | y.own << 1 | z.own, x.own << 2 | y.other << 1 | z.own,
                                   x.own << 2 | y.own << 1 | z.other, x.other << 2 | y.other << 1 | z.own,
                                   x.other << 2 | y.own << 1 | z.other, x.own << 2 | y.other << 1 | z.other,
                                   x.other << 2 | y.other << 1 | z.other}))
    return false;
  add_dart(place, own);
  return true;
}

void Sampler::add_dart(const Place& place, std::uint32_t bin) {
  std::uint32_t q = bins_[bin];
  if (q == kNoDarts) used_bins_.push_back(bin);
  if (q == kNoDarts || quivers_[q].count == 4) {
    quivers_.push_back(empty_quiver());
    quivers_.back().next = q;
    q = bins_[bin] = static_cast<std::uint32_t>(quivers_.size() - 1);
  }
  Quiver& quiver = quivers_[q];
  quiver.x[quiver.count] = place.x;
  quiver.y[quiver.count] = place.y;
  quiver.z[quiver.count] = place.z;
  ++quiver.count;
}

}  // namespace stipple
