// Which points an inner node takes from its children. Trees are built from the leaves up: a node chooses among the
// points that its children chose among theirs, leaves offering all they have; what it takes is no longer theirs.
//
// Poisson: no two points of an inner node are closer than the node's spacing (kPoissonFraction of it), and neither are
// two points of the node and those of its ancestors that lie inside its cell. Every point that its children offered and
// it did not take is closer than that to one that it took. Candidates are thrown like darts in an even, repeatable
// order. Source of the idea: Schuetz, Ohrhallinger, Wimmer, "Fast Out-of-Core Octree Generation for Massive Point
// Clouds", 2020, section 3.2.2; spacing as there and in PotreeConverter: edge of the root / 128 / 2^level.
//
// Random: one point of each occupied cell of a lattice of 128^3 cells inside the node, the one of lowest rank, which is
// each with the same probability. There is no smallest distance: two points may touch across a border of cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octree/build/coded_point.h"
#include "octree/build/morton.h"
#include "octree/build/stream/options.h"
#include "octree/core/buffer.h"

namespace stipple {

// The least distance between points of an inner node, in spacings.
inline constexpr double kPoissonFraction = 1.0;

// Points in ascending order of code. Does not own them.
struct SortedPoints {
  std::span<const CodedPoint> coded;  // ids are indices in `records`
  std::span<const glm::ivec3> positions;
  const std::byte* records = nullptr;
};

// The cube that a tree divides, on its grid.
struct CubeFrame {
  Grid grid;
  GridBox bounds;
  RootCube cube;
};

// Spacing of the points of an inner node, world units.
double spacing_of_level(const RootCube& cube, int level);

// Reused from node to node; one a thread.
class Sampler {
 public:
  Sampler(Sampling sampling, const CubeFrame& frame) : sampling_(sampling), frame_(frame) {}

  // taken[i] = 1 for each candidate, an index in `points`, that the node of `level` takes, else 0. Candidates ascend
  // and lie in the node's cell.
  void select(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
              Buffer<std::uint8_t>& taken);

 private:
  struct Place {  // in spacings, from the corner of the node's cell
    float x, y, z;
  };
  // Up to four darts of one bin, so that one instruction compares with all: lanes without one are far away.
  using Lanes = float __attribute__((vector_size(16)));
  struct alignas(64) Quiver {
    Lanes x, y, z;
    std::uint32_t next;  // earlier quiver of the bin; kNoDarts, the first of all, for none
    std::uint32_t count;
  };

  void select_random(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
                     std::span<std::uint8_t> taken) const;
  void select_poisson(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level,
                      std::span<std::uint8_t> taken);
  void locate(const SortedPoints& points, std::span<const std::uint32_t> candidates, int level);
  template <std::size_t kBins>
  bool meets_dart(const Place& place, const std::array<std::uint32_t, kBins>& bins) const;
  bool throw_dart(const Place& place);
  void add_dart(const Place& place, std::uint32_t bin);
  static Quiver empty_quiver();

  Sampling sampling_;
  CubeFrame frame_;
  Buffer<Place> places_;  // of the candidates
  std::vector<Quiver> quivers_;
  std::vector<std::uint32_t> used_bins_;
  std::vector<std::uint32_t> bins_;  // latest quiver in each
};

}  // namespace stipple
