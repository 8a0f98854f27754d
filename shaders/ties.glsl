// Points that share pixel and depth: the lowest id wins. Whoever lowers a pixel's id writes the pixel at once; where
// several did so in one pass their writes may have landed in any order, so all but the first also note themselves here,
// and the note that holds the lowest id writes once more (settle_ties.glsl). When the notes overflow, the whole pass is
// repeated for winners only.
struct Tie {
  ivec4 point;
  uint id;
  uint pixel;  // x | y << 16
};

layout(std430, binding = 3) buffer Ties {
  uint tie_count;
  uint repeat_groups[3];      // glDispatchComputeIndirect of the repeated pass; x is 0 unless the notes overflow
  uint repeat_instances;      // likewise, instances drawn
  uint tie_padding[3];
  Tie ties[];
};

const uint kRepeatGroups = 1024;

void note_tie(ivec4 point, uint id, ivec2 pixel) {
  uint slot = atomicAdd(tie_count, 1u);
  if (slot < uint(ties.length())) {
    ties[slot] = Tie(point, id, uint(pixel.x) | uint(pixel.y) << 16);
  } else {
    repeat_groups[0] = kRepeatGroups;
    repeat_instances = 1u;
  }
}
