// Eye-dome lighting of a finished frame (Boucheny 2009): a point is as dark as what is around it is nearer than it. Ratios of
// distances count, not distances, so that it looks the same near and far, whatever the cloud's unit.
#include "packing.glsl"
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform isampler2D points;
layout(binding = 1) uniform usampler2D ids;
layout(r32ui, binding = 0) uniform writeonly uimage2D colors;
layout(location = 0) uniform float darkness;  // for each halving of the distance
layout(location = 1) uniform float radius;    // pixels
#ifdef FROM_ATTACHMENT
layout(binding = 2) uniform sampler2D depth;
float closeness_at(ivec2 pixel) { return texelFetch(depth, pixel, 0).x; }
#else
layout(binding = 2) uniform usampler2D depth;
float closeness_at(ivec2 pixel) { return uintBitsToFloat(texelFetch(depth, pixel, 0).x); }
#endif

const int kNeighbours = 8;

// Mean over the neighbours of how often the distance halves from here to there. Closeness is near / distance, 0 where
// nothing is: what shows the background does not darken.
float obscurance(ivec2 pixel) {
  ivec2 last = textureSize(ids, 0) - 1;
  float here = log2(closeness_at(pixel));
  float sum = 0.0;
  for (int i = 0; i < kNeighbours; ++i) {
    float angle = 6.2831853 * float(i) / float(kNeighbours);
    ivec2 there = clamp(pixel + ivec2(round(radius * vec2(cos(angle), sin(angle)))), ivec2(0), last);
    float closeness = closeness_at(there);
    if (closeness > 0.0) sum += max(0.0, log2(closeness) - here);
  }
  return sum / float(kNeighbours);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  uint shaded = 0u;
  if (texelFetch(ids, pixel, 0).x != kNoPoint) {
    vec3 color = vec3((ivec3(texelFetch(points, pixel, 0).w) >> ivec3(0, 8, 16)) & 255);
    uvec3 c = uvec3(color * exp(-darkness * obscurance(pixel)) + 0.5);
    shaded = c.x | c.y << 8 | c.z << 16 | 0xFF000000u;
  }
  imageStore(colors, pixel, uvec4(shaded));
}
