// One invocation: the number of carried vertices becomes the command that rasterizes them.
#include "packing.glsl"
layout(local_size_x = 1) in;

layout(std430, binding = 2) buffer Command { CarriedCommand command; };
layout(location = 0) uniform uint group_size;

void main() {
  uint groups = (command.count + group_size - 1u) / group_size;
  uint rows = (groups + 65534u) / 65535u;
  command.instance_count = 1u;
  command.groups_x = rows == 0u ? 0u : (groups + rows - 1u) / rows;
  command.groups_y = max(rows, 1u);
  command.groups_z = 1u;
}
