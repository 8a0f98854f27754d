// Every cluster that is urgent enough goes on by a stretch. Stretches stand in the order of clusters, hence of chunks, and so do
// their points: the same budget takes the same points on any machine. An invocation works off a block of clusters, because
// barriers cost more than that on Mesa's software renderer.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"
#include "wishes.glsl"

layout(std430, binding = 2) writeonly buffer OpenClusters { uint open_clusters[]; };
layout(std430, binding = 7) writeonly buffer Stretches { Stretch stretches[]; };

void main() {
  uint block = invocation_index();
  if (block >= blocks) return;
  uint first = block * BLOCK;
  uvec4 before = block_sums[block];
  uint begin = before.x + min(before.z, totals.allowance);
  uint place = boxes[first].place;
  if ((place & kPlaceMask) == 0u) chunk_begins[place >> kPlaceBits] = uvec2(begin, before.y + before.w);

  uint open = 0u;  // a bit for each of the block
  for (uint left = wishing[block]; left != 0u; left &= left - 1u) {
    uint i = first + uint(findLSB(left));
    uvec4 wish = wish_of(i);
    uint slot = before.y + before.w;
    before += wish;
    uint end = before.x + min(before.z, totals.allowance);
    bool taken = wish.y + wish.w > 0u;
    if (taken) stretches[slot] = Stretch(i, begin, states[i].drawn, end - begin);
    if (!taken || points_left(states[i], boxes[i].count) > end - begin) open |= 1u << i - first;
    begin = end;
  }
  wishing[block] = 0u;  // until they are asked again
  if (block == blocks - 1u) {
    totals.points = begin;
    totals.stretches = before.y + before.w;
  }
  for (uint slot = atomicAdd(totals.open, uint(bitCount(open))); open != 0u; open &= open - 1u)
    open_clusters[slot++] = first + uint(findLSB(open));
}
