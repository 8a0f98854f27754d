// One invocation: the budget goes to the most urgent clusters. Where all of them ask for less, each gets more than
// that in proportion.
#include "clusters.glsl"
layout(local_size_x = 1) in;

layout(std430, binding = 5) buffer Summary { Totals totals; uvec2 chunk_begins[MOST_CHUNKS]; uint urgencies[]; };
layout(location = 0) uniform uint budget;
layout(location = 1) uniform bool joins_rounds;

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
  totals.factor = urgency < 0 && joins_rounds ? float(budget) / float(max(budget - left, 1u)) : 1.0;
}
