// What mode hybrid leaves out because the picture does not need it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace stipple {

// Each may be turned off, to see what it is worth: the converged picture is the same.
struct Skips {
  bool frustum = true;     // clusters outside of the view
  bool occlusion = true;   // clusters, and shards of them, that are wholly hidden
  bool density = true;     // for now: more points of a cluster than can cover pixels
  bool yield = true;       // for now: clusters whose points are not seen
  bool rounds = true;      // frames that one round of all clusters would not fill
  bool done = true;        // looking again at clusters that have nothing left
  bool still = true;       // drawing anew, in the frame of a still view, what the last one shows
  bool converged = true;   // frames of a view that has nothing left
  bool attributes = true;  // reading attributes that are not shown
  bool nodes = true;       // reading nodes of an octree on disk that the view does not need

  bool operator==(const Skips&) const = default;
};

struct NamedSkip {
  std::string_view name;
  bool Skips::*member;
};
std::span<const NamedSkip> all_skips();

// What was left out of the current view, of the points that are on the GPU.
struct SkipCounts {
  std::uint64_t clusters_outside = 0;  // of the frustum
  std::uint64_t points_outside = 0;
  std::uint64_t clusters_hidden = 0;  // wholly: points drawn before that count as drawn
  std::uint64_t points_hidden = 0;    // in them, and in shards that are hidden or outside of the frustum
  std::uint64_t points_put_off = 0;   // more than the pixels that their clusters are estimated to cover
  std::uint64_t clusters_done = 0;    // with nothing left, and not hidden
  std::uint64_t rounds_joined = 0;    // frames that would not have been full otherwise
};

}  // namespace stipple
