// What the passes that select clusters share (render/method/cluster_selector.cpp drives them):
//   select_outline once a view: which clusters are in sight, and where on the screen
//   select_test    which of them are wholly behind the depth already drawn
//   select_score   what each would draw next, and how urgently
//   select_cut     how urgent is urgent enough for the budget
//   select_scan    prefix sums over the clusters that are, in two steps
//   select_take    these clusters go on by a stretch each
//   expand_stretch the places of a stretch's points
//   measure_yield  how many of a stretch's points are seen once they are drawn
//   test_shards    which shards of its cluster are behind what is drawn then
//   count_skips    what was left out, when somebody asks
struct ClusterBox {
  ivec3 low;    // tight, closed
  uint place;   // of its first point in its chunk's buffer, and the chunk above kPlaceBits
  ivec3 high;
  uint count;   // points
};

const uint kPlaceBits = 22;
const uint kPlaceMask = (1u << kPlaceBits) - 1u;

// Of this view. A cluster's points are drawn in circles: from `start` on, `drawn` of them until now, hidden shards left out.
struct ClusterState {
  uint start;
  uint drawn;
  uint status;
  float seen;   // share of its latest points that won their pixel: the yield
  uvec4 hidden;  // shards that the first eye cannot see, a bit each, and those that the second cannot
};

// The tiles of the depth pyramid that a cluster may touch, pixels on level 0; x below y in 16 bits each.
struct Silhouette {
  uint low;
  uint high;
  float depth;  // of its nearest place, rounded towards the eye; reversed, so that nearer is larger
  uint level;
};

uint pack_tile(ivec2 tile) { return uint(tile.x) | uint(tile.y) << 16; }
ivec2 unpack_tile(uint tile) { return ivec2(tile & 0xFFFFu, tile >> 16); }

// What there is to win, as of the last test.
struct Prospect {
  float pixels;    // that all of its points are estimated to cover
  float distance;  // of the nearest place along the line of sight, world units, that of the near plane at least
  float open;      // share of the places under its outline where it may be seen
};

// From a ShardBox of render/store/shards.h and the corners of the cluster's box.
void shard_box(uvec2 cells, vec3 low, vec3 high, out vec3 from, out vec3 to) {
  vec3 cell = (high - low) / 1024.0;
  from = low + cell * vec3(uvec3(cells.x, cells.x >> 10, cells.x >> 20) & 1023u);
  to = low + cell * vec3((uvec3(cells.y, cells.y >> 10, cells.y >> 20) & 1023u) + 1u);
}

// Those that no eye can see, a bit each.
uvec2 hidden_shards(ClusterState state) { return state.hidden.xy & state.hidden.zw; }

// Points in the first places of a cluster, without those of hidden shards.
uint points_before(uint places, uvec2 hidden) {
  ivec2 open = bitCount(~hidden);
  uint rest = places % SHARDS;
  uint of_rest = uint(bitCount(~hidden[rest / 32u] & ((1u << rest % 32u) - 1u))) + (rest < 32u ? 0u : uint(open.x));
  return places / SHARDS * uint(open.x + open.y) + of_rest;
}

// Points of a cluster of `count` that are to be drawn yet, without those of hidden shards.
uint points_left(ClusterState state, uint count) {
  uvec2 hidden = hidden_shards(state);
  if (hidden == uvec2(0u)) return count - state.drawn;
  // From here around the end to the start
  uint from = state.start + state.drawn;
  uint before_start = points_before(state.start, hidden);
  if (from >= count) return before_start - points_before(from - count, hidden);
  return before_start + points_before(count, hidden) - points_before(from, hidden);
}

const uint kOutside = 0u;
const uint kOpen = 1u;
const uint kOccluded = 2u;

// Points of one cluster to draw in this frame.
struct Stretch {
  uint cluster;
  uint begin;  // of all stretches' points
  uint first;  // of the cluster's circle
  uint count;  // may be 0
};

// What a cluster asks for: points in the lower bits, urgency in the upper.
const uint kWishBits = 22;
const uint kWishMask = (1u << kWishBits) - 1u;
const uint kUrgencies = 1024;

// Clusters, since the view began.
struct Sight {
  uint visible;   // in the frustum
  uint occluded;  // of those, wholly behind what is drawn
};

struct Totals {
  uint points;     // taken in this frame
  uint stretches;
  uint open;       // clusters with points left after it
  int cut;         // clusters above this urgency are taken whole, those of it as far as `allowance` goes
  uint allowance;
  float factor;    // of what each asks for, where that is less than the budget
};
