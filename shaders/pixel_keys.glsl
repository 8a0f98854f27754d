// Who owns each pixel, as one number: the bits of its depth, which is positive and reversed, over the complement of its id.
// The greatest is the nearest point, and of equally near ones that with the lowest id. 0 where no point is. Needs 64-bit
// integers and atomics: who includes this asks for the extensions.
layout(std430, binding = 5) buffer PixelKeys { uint64_t pixel_keys[]; };

uint64_t key_of(uint depth, uint id) { return packUint2x32(uvec2(~id, depth)); }
