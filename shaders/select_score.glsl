// How many points each cluster asks for, and how urgently. Asking for half of the pixels it can cover instead of all drew 1 to 4
// % fewer points until 40 dB (stipple study city20.las --modes hybrid --budget 250k).
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) readonly buffer States { ClusterState states[]; };
layout(std430, binding = 3) buffer Wishing { uint wishing[]; };  // a bit for each of a block of BLOCK clusters
layout(std430, binding = 4) writeonly buffer Wishes { uint wishes[]; };
layout(std430, binding = 5) buffer Summary { Totals totals; uvec2 chunk_begins[MOST_CHUNKS]; uint urgencies[]; };
layout(std430, binding = 7) readonly buffer Prospects { Prospect prospects[]; };
layout(std430, binding = 2) readonly buffer OpenClusters { uint open_clusters[]; };
layout(location = 0) uniform uint count;  // clusters to do
layout(location = 1) uniform bool by_yield;
layout(location = 2) uniform float near;  // of the view
layout(location = 3) uniform bool all;    // not of the open clusters, but of all
layout(location = 4) uniform bool by_density;

// What another point of a cluster is expected to mend, 1 at most. Of those that may be seen each is as likely as the others to be
// the one that its pixel shows in the end; and pixels that nothing covers yet are worth more. That alone is as good as what was
// measured of the cluster's points where surfaces hide each other, and takes 15 % fewer until 40 dB over open land.
float worth_of(ClusterState state, Prospect prospect, uint count) {
  const float kUncovered = 2.0;  // times a pixel that shows the wrong point
  if (!by_density) prospect.pixels = float(count);
  float last = min(prospect.pixels / float(count), 1.0);
  float first = exp(-float(state.drawn) / prospect.pixels);
  // What is nearly hidden waits: it may soon be hidden wholly
  return mix(0.5, 1.0, state.seen) * prospect.open * (last + kUncovered * first) / (1.0 + kUncovered);
}

// New clusters first, near ones before far ones, sixteen classes to a doubling of the distance; then by worth, fifty classes to
// a halving.
uint urgency_of(ClusterState state, Prospect prospect, uint count) {
  const float kHalf = float(kUrgencies / 2u);
  if (state.drawn == 0u && (state.seen * prospect.open == 1.0 || !by_yield))
    return kUrgencies - 1u - uint(clamp(16.0 * log2(prospect.distance / near), 0.0, kHalf - 1.0));
  if (!by_yield) return 0u;
  return uint(clamp(kHalf - 1.0 + 50.0 * log2(max(worth_of(state, prospect, count), 1e-6)), 0.0, kHalf - 1.0));
}

void main() {
  // Points: shorter stretches cost more to select than to draw, longer ones draw what would be hidden a frame later. The first
  // need not be as long: all clusters in sight draw it. Each next one draws as many as were drawn before it: a quarter less is
  // selected, 1 to 3 % more drawn.
  const uint kLeastAtFirst = 4u;
  const uint kLeast = 16u;
  uint i = invocation_index();
  if (i >= count) return;
  if (!all) i = open_clusters[i];
  ClusterState state = states[i];
  uint rest = points_left(state, boxes[i].count);
  if (state.status != kOpen || rest == 0u) return;
  Prospect prospect = prospects[i];
  uint least = state.drawn == 0u ? kLeastAtFirst : max(kLeast, state.drawn);
  uint wish = by_density ? min(uint(clamp(ceil(0.5 * prospect.pixels), float(least), 65536.0)), rest) : rest;
  uint urgency = urgency_of(state, prospect, boxes[i].count);
  atomicOr(wishing[i / BLOCK], 1u << i % BLOCK);
  wishes[i] = urgency << kWishBits | wish;
  atomicAdd(urgencies[urgency], wish);
}
