// One invocation: the number of points in a list becomes the command that rasterizes them.
#include "vertex_list.glsl"
layout(local_size_x = 1) in;

layout(location = 0) uniform uint group_size;

void main() {
  list_command.instance_count = 1u;
  set_groups(list_command, group_size);
}
