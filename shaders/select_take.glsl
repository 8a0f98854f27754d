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
  uint first = block * BLOCK;
  if (first >= clusters) return;
  uvec4 before = block_sums[block];
  uvec2 counts = uvec2(0u);  // visible, occluded
  uint open = 0u;            // a bit for each of the block
  for (uint i = first; i < min(first + BLOCK, clusters); ++i) {
    uvec4 wish = wish_of(i);
    uvec4 end = before + wish;
    uint begin = before.x + min(before.z, totals.allowance);
    uint slot = before.y + before.w;
    uint count = end.x + min(end.z, totals.allowance) - begin;
    before = end;

    ClusterBox box = boxes[i];
    ClusterState state = states[i];
    if ((box.place & kPlaceMask) == 0u) chunk_begins[box.place >> kPlaceBits] = uvec2(begin, slot);
    if (wish.y + wish.w > 0u) {
      stretches[slot] = Stretch(i, begin, state.drawn, count);
      states[i].drawn = state.drawn + count;
    }
    counts += uvec2(state.status != kOutside, state.status == kOccluded);
    if (state.status == kOpen && state.drawn + count < box.count) open |= 1u << i - first;
    if (i == clusters - 1u) {
      totals.points = begin + count;
      totals.stretches = end.y + end.w;
    }
  }
  atomicAdd(totals.visible, counts.x);
  atomicAdd(totals.occluded, counts.y);
  for (uint slot = atomicAdd(totals.open, uint(bitCount(open))); open != 0u; open &= open - 1u)
    open_clusters[slot++] = first + uint(findLSB(open));
}
