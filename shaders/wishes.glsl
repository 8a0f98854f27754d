// What a cluster asks for, after the cut.
layout(std430, binding = 0) readonly buffer Boxes { ClusterBox boxes[]; };
layout(std430, binding = 1) buffer States { ClusterState states[]; };
layout(std430, binding = 4) readonly buffer Wishes { uint wishes[]; };
layout(std430, binding = 3) buffer Wishing { uint wishing[]; };  // a bit for each of a block of BLOCK clusters
layout(std430, binding = 5) buffer Summary { Totals totals; uvec2 chunk_begins[MOST_CHUNKS]; uint urgencies[]; };
layout(std430, binding = 6) buffer BlockSums { uvec4 block_sums[]; };
layout(location = 0) uniform uint blocks;

// Points and clusters above the cut (x, y) and at the cut (z, w).
uvec4 wish_of(uint i) {
  uint wish = wishes[i] & kWishMask;
  if (totals.factor > 1.0) wish = uint(min(float(wish) * totals.factor, float(points_left(states[i], boxes[i].count))));
  int urgency = int(wishes[i] >> kWishBits);
  if (urgency < totals.cut) return uvec4(0u);
  return urgency > totals.cut ? uvec4(wish, 1u, 0u, 0u) : uvec4(0u, 0u, wish, 1u);
}
