#include "octree/read/gather.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace stipple {
namespace {

// A constant size turns memcpy into one or two moves.
template <std::size_t kSize>
void gather(const std::byte* in, std::size_t stride, std::size_t count, std::byte* out) {
  for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * kSize, in + i * stride, kSize);
}

template <std::size_t kSize>
void reverse(std::byte* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) std::reverse(values + i * kSize, values + (i + 1) * kSize);
}

}  // namespace

void gather(std::size_t size, const std::byte* in, std::size_t stride, std::size_t count, std::byte* out) {
  switch (size) {
    case 1:
      return gather<1>(in, stride, count, out);
    case 2:
      return gather<2>(in, stride, count, out);
    case 4:
      return gather<4>(in, stride, count, out);
    case 6:
      return gather<6>(in, stride, count, out);
    case 8:
      return gather<8>(in, stride, count, out);
    case 12:
      return gather<12>(in, stride, count, out);
    default:
      for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * size, in + i * stride, size);
  }
}

void swap_bytes(std::size_t size, std::byte* values, std::size_t count) {
  switch (size) {
    case 2:
      return reverse<2>(values, count);
    case 4:
      return reverse<4>(values, count);
    case 8:
      return reverse<8>(values, count);
    default:
      return;
  }
}

}  // namespace stipple
