// Every cluster that is urgent enough goes on by a stretch. Stretches stand in the order of clusters, hence of chunks, and so do
// their points: the same budget takes the same points on any machine.
#include "clusters.glsl"
layout(local_size_x = GROUP) in;
#include "invocation.glsl"
#include "wishes.glsl"

layout(std430, binding = 7) writeonly buffer Stretches { Stretch stretches[]; };

shared uvec4 sums[GROUP];

// Sums over the lanes up to and including this one.
uvec4 inclusive_sum(uint lane, uvec4 value) {
  sums[lane] = value;
  barrier();
  for (uint step = 1u; step < GROUP; step *= 2u) {
    uvec4 lower = lane >= step ? sums[lane - step] : uvec4(0u);
    barrier();
    sums[lane] += lower;
    barrier();
  }
  return sums[lane];
}

void main() {
  uint i = invocation_index();
  uvec4 wish = wish_of(i);
  uvec4 end = inclusive_sum(gl_LocalInvocationID.x, wish);
  if (i >= clusters) return;
  end += group_sums[i / GROUP];
  uvec4 before = end - wish;
  uint begin = before.x + min(before.z, totals.allowance);
  uint slot = before.y + before.w;
  uint count = end.x + min(end.z, totals.allowance) - begin;

  if ((boxes[i].place & kPlaceMask) == 0u) chunk_begins[boxes[i].place >> kPlaceBits] = uvec2(begin, slot);
  if (wish.y + wish.w > 0u) stretches[slot] = Stretch(i, begin, states[i].drawn, count);
  states[i].drawn += count;
  if (states[i].status == kOpen && states[i].drawn < boxes[i].count) atomicAdd(totals.open, 1u);
  if (i == clusters - 1u) {
    totals.points = begin + count;
    totals.stretches = end.y + end.w;
  }
}
