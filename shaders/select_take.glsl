// Every cluster that is urgent enough goes on by a stretch. Stretches stand in the order of clusters, hence of chunks, and so do
// their points: the same budget takes the same points on any machine. An invocation works off a block of clusters, because
// barriers cost more than that on Mesa's software renderer.
#include "clusters.glsl"
layout(local_size_x = 64) in;
#include "invocation.glsl"
#include "wishes.glsl"

layout(std430, binding = 7) writeonly buffer Stretches { Stretch stretches[]; };

void main() {
  uint block = invocation_index();
  uint first = block * BLOCK;
  if (first >= clusters) return;
  uvec4 before = block_sums[block];
  uvec3 counts = uvec3(0u);  // visible, occluded, open
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
    counts += uvec3(state.status != kOutside, state.status == kOccluded,
                    state.status == kOpen && state.drawn + count < box.count);
    if (i == clusters - 1u) {
      totals.points = begin + count;
      totals.stretches = end.y + end.w;
    }
  }
  atomicAdd(totals.visible, counts.x);
  atomicAdd(totals.occluded, counts.y);
  atomicAdd(totals.open, counts.z);
}
