// Points that a pass collects as whole vertices for a later one to draw: who takes room adds to list_command.count.
#include "packing.glsl"

layout(std430, binding = 0) writeonly buffer ListPoints { ivec4 list_points[]; };
layout(std430, binding = 1) writeonly buffer ListIds { uint list_ids[]; };
layout(std430, binding = 2) buffer ListCommand { IndirectCommand list_command; };

void put_into_list(uint place, ivec4 point, uint id) {
  list_points[place] = point;
  list_ids[place] = id;
}
