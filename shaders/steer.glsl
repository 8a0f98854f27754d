// The adaptive fill of S19: what the last frame took, by the GPU's own clock, says how many of the slots are next, and
// the commands that draw them are written here. One work group.
#include "packing.glsl"
#include "budget.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer State {
  Budget budget;
  uint cursor;  // first slot of the next stretch
  uint left;    // slots not drawn in this round
  uint round;   // number
  uint drawn;   // slots of the last stretch
  uint total;   // of all stretches, modulo 2^32
};
layout(std430, binding = 1) readonly buffer Stamps {
  uvec2 began;  // the frame of the last stretch, in nanoseconds: lower half, upper half
  uvec2 ended;
};
layout(std430, binding = 2) writeonly buffer Commands { IndirectCommand commands[]; };  // one a chunk

layout(location = 0) uniform uint slots;
layout(location = 1) uniform uint most;           // slots a frame may draw, whatever the time allows
layout(location = 2) uniform uint current_round;  // another than the last: all slots are to be drawn
layout(location = 3) uniform bool timed;          // the last stretch has time stamps
layout(location = 4) uniform uint chunk_slots;
layout(location = 5) uniform uint group_size;

shared uint stretch_first;
shared uint stretch_count;

double milliseconds(uvec2 from, uvec2 to) {
  uint borrow;
  uint low = usubBorrow(to.x, from.x, borrow);
  uint high = to.y - from.y - borrow;
  return (double(high) * 4294967296.0lf + double(low)) * 1e-6lf;
}

void choose_stretch() {
  if (timed) frame_done(budget, double(drawn), milliseconds(began, ended));
  if (round != current_round) {
    round = current_round;
    left = slots;
  }
  stretch_first = cursor;
  stretch_count = min(min(budget.points_next, most), left);
  drawn = stretch_count;
  total += stretch_count;
  left -= stretch_count;
  uint before_end = slots - cursor;
  cursor = stretch_count < before_end ? cursor + stretch_count : stretch_count - before_end;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) choose_stretch();
  barrier();
  uint before_end = min(stretch_count, slots - stretch_first);
  uint after_end = stretch_count - before_end;
  uint chunks = (slots + chunk_slots - 1u) / chunk_slots;
  for (uint c = gl_LocalInvocationIndex; c < chunks; c += gl_WorkGroupSize.x) {
    uint chunk_first = c * chunk_slots;
    uint chunk_size = min(chunk_slots, slots - chunk_first);
    // Its slots in [stretch_first, stretch_first + before_end); those in [0, after_end) follow around its end
    uint begin = max(stretch_first, chunk_first) - chunk_first;
    uint end = min(max(stretch_first + before_end, chunk_first) - chunk_first, chunk_size);
    uint again = min(max(after_end, chunk_first) - chunk_first, chunk_size);
    IndirectCommand command;
    command.begin = begin < end ? begin : 0u;
    command.count = (begin < end ? end - begin : 0u) + again;
    command.instance_count = 1u;
    command.first = 0u;
    command.base_instance = 0u;
    set_groups(command, group_size);
    commands[c] = command;
  }
}
