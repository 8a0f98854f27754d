// What moved between two runs of `stipple bench`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/json/json.h"

namespace stipple {

struct Move {
  std::string part;
  double old_ms = 0.0;  // medians
  double new_ms = 0.0;

  double ratio() const { return new_ms / old_ms; }
};

// What a method now draws to reach a quality, and drew.
struct PointsMove {
  std::string part;
  double old_points = 0.0;
  double new_points = 0.0;

  double ratio() const { return new_points / old_points; }
};

struct BenchComparison {
  std::vector<Move> moved;               // beyond noise, in the order of the new run
  std::vector<PointsMove> other_points;  // points have no noise: any difference counts
  std::size_t compared = 0;              // parts that both have
  std::vector<std::string> differences;  // in machine, cloud or settings: then times say little. In sentences
};

// A part has moved when every new run was faster, or every one slower, than all old ones: by chance that happens to
// one part in 126 with five runs each (2 of the 252 ways to order ten runs), so hundreds of runs without a
// change show a few. Both documents as `stipple bench --json` prints them.
// Throws Error naming `old_path` when the old one is no such document.
BenchComparison compare_benches(const Json& old_document, const Json& new_document, const std::string& old_path);

}  // namespace stipple
