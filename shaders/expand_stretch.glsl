// An invocation a stretch: where its points are in their chunk's buffer. Shards that cannot be seen are left out.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 7) readonly buffer Stretches { Stretch stretches[]; };
layout(std430, binding = 2) writeonly buffer Places { uint places[]; };
layout(location = 0) uniform uint stretch_count;

// How many shards on from `shard` the next open one is, around the end.
uint to_next(uvec2 open, uint shard) {
  uint word = shard / 32u;
  uint at = shard % 32u;
  uint bits = open[word] >> at;
  if (bits != 0u) return uint(findLSB(bits));
  uint others = open[1u - word];
  return others != 0u ? 32u - at + uint(findLSB(others)) : 64u - at + uint(findLSB(open[word]));
}

void main() {
  uint s = invocation_index();
  if (s >= stretch_count) return;
  Stretch stretch = stretches[s];
  ClusterState state = states[stretch.cluster];
  uint first = boxes[stretch.cluster].place & kPlaceMask;
  uint size = boxes[stretch.cluster].count;
  uvec2 open = ~hidden_shards(state);
  uint first_open = to_next(open, 0u);
  uint place = state.start + stretch.first;
  if (place >= size) place -= size;
  uint passed = 0u;
  for (uint k = 0u; k < stretch.count; ++k) {
    // On to the next place of an open shard, around the end of the circle
    uint step = to_next(open, place % SHARDS);
    if (place + step >= size) step = size - place + first_open;
    passed += step + 1u;
    place += step;
    if (place >= size) place -= size;
    places[stretch.begin + k] = first + place;
    if (++place == size) place = 0u;
  }
  state.drawn = stretch.first + passed;
  if (points_left(state, size) == 0u) state.drawn = size;  // what is left of the circle is hidden
  states[stretch.cluster].drawn = state.drawn;
}
