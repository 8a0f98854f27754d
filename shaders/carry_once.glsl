// A point that covers several pixels is carried into the next frame by one of them. Ids share places of a table by their
// hash. MARK: the first pixel of each place. Then the others keep their id only where the place went to another
// id, and there only at the upper left ends of what the point covers: seldom, as points that cover much are few.
#include "packing.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 1) uniform usampler2D target_ids;
layout(std430, binding = 0) buffer Firsts { uint firsts[]; };  // as many as there are pixels
#ifndef MARK
layout(r32ui, binding = 0) uniform writeonly uimage2D carried_ids;
#endif

uint id_at(ivec2 pixel) { return texelFetch(target_ids, pixel, 0).x; }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(target_ids, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  uint id = id_at(pixel);
  uint number = uint(pixel.y * size.x + pixel.x);
  // Knuth 1973, section 6.4: multiplicative hashing
  uint place = id * 2654435761u % uint(size.x * size.y);
#ifdef MARK
  if (id != kNoPoint) atomicMin(firsts[place], number);
#else
  if (id != kNoPoint) {
    uint first = firsts[place];
    bool carries = first == number;
    if (!carries && id_at(ivec2(first % uint(size.x), first / uint(size.x))) != id)
      carries = (pixel.x == 0 || id_at(pixel - ivec2(1, 0)) != id) && (pixel.y == 0 || id_at(pixel - ivec2(0, 1)) != id);
    if (!carries) id = kNoPoint;
  }
  imageStore(carried_ids, pixel, uvec4(id));
#endif
}
