// What the passes hand to each other. A point is ivec4(position on the grid, packed rgba), its id a uint beside it.

// The id that stands for "no point": point 0 is a point.
const uint kNoPoint = 0xFFFFFFFFu;

// Carried vertices: how many there are, and the commands that draw them.
struct CarriedCommand {
  uint count;           // glDrawArraysIndirect: vertices,
  uint instance_count;  // instances,
  uint first;           // first vertex,
  uint base_instance;   // base instance
  uint groups_x;        // glDispatchComputeIndirect
  uint groups_y;
  uint groups_z;
};
