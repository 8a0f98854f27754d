// What the passes hand to each other. A point is ivec4(position on the grid, packed rgba), its id a uint beside it.

// The id that stands for "no point": point 0 is a point.
const uint kNoPoint = 0xFFFFFFFFu;

// Points of which only the GPU knows how many there are, or where: carried ones, or those it steers. And the commands that
// draw them.
struct IndirectCommand {
  uint count;           // glDrawArraysIndirect: vertices,
  uint instance_count;  // instances,
  uint first;           // first vertex,
  uint base_instance;   // base instance
  uint groups_x;        // glDispatchComputeIndirect
  uint groups_y;
  uint groups_z;
  uint begin;           // place of the first, where they begin elsewhere than at 0
};

// How the compute rasterizer draws command.count points in work groups of this size.
void set_groups(inout IndirectCommand command, uint group_size) {
  uint groups = (command.count + group_size - 1u) / group_size;
  uint rows = (groups + 65534u) / 65535u;
  command.groups_x = rows == 0u ? 0u : (groups + rows - 1u) / rows;
  command.groups_y = max(rows, 1u);
  command.groups_z = 1u;
}
