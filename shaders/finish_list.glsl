// One invocation: the number of carried vertices becomes the command that rasterizes them.
#include "packing.glsl"
layout(local_size_x = 1) in;

layout(std430, binding = 2) buffer Command { IndirectCommand command; };
layout(location = 0) uniform uint group_size;

void main() {
  command.instance_count = 1u;
  set_groups(command, group_size);
}
