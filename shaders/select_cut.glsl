// One invocation: the budget goes to the most urgent clusters. Where all of them ask for less, each gets several times what
// it asks for.
#include "clusters.glsl"
layout(local_size_x = 1) in;

layout(std430, binding = 5) buffer Summary { Totals totals; uvec2 chunk_begins[MOST_CHUNKS]; uint urgencies[]; };
layout(location = 0) uniform uint budget;

void main() {
  uint left = budget;
  int urgency = int(kUrgencies) - 1;
  for (; urgency >= 0; --urgency) {
    uint asked = urgencies[urgency];
    if (asked > left) break;
    left -= asked;
  }
  totals.cut = urgency;
  totals.allowance = left;
  // At most 2^15 of wishes below 2^17 fit 32 bits
  totals.factor = urgency < 0 ? min(budget / max(budget - left, 1u), 32768u) : 1u;
}
