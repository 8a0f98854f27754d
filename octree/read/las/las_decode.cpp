#include "octree/read/las/las_decode.h"

#include <cstring>

namespace stipple::las {
namespace {

// Rows `stride` apart to tight rows of kSize bytes. A constant size turns memcpy into one or two moves.
template <std::size_t kSize>
void gather(const std::byte* in, std::size_t stride, std::size_t count, std::byte* out) {
  for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * kSize, in + i * stride, kSize);
}

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
    default:
      for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * size, in + i * stride, size);
  }
}

void gather_bits(const Field& field, const std::byte* in, std::size_t stride, std::size_t count, std::byte* out) {
  const std::byte mask{static_cast<unsigned char>((1u << field.bits) - 1u)};
  for (std::size_t i = 0; i < count; ++i) out[i] = (in[i * stride] >> field.shift) & mask;
}

}  // namespace

void decode_positions(std::span<const std::byte> records, std::size_t record_length, std::span<glm::ivec3> out) {
  static_assert(sizeof(glm::ivec3) == 12, "x, y and z stand side by side, as in a record");
  gather<sizeof(glm::ivec3)>(records.data(), record_length, out.size(), std::as_writable_bytes(out).data());
}

void decode_field(const Field& field, std::span<const std::byte> records, std::size_t record_length,
                  std::span<std::byte> out) {
  const std::byte* const first = records.data() + field.offset;
  const std::size_t count = out.size() / field.attribute.bytes();
  if (field.bits != 0)
    gather_bits(field, first, record_length, count, out.data());
  else
    gather(field.attribute.bytes(), first, record_length, count, out.data());
}

}  // namespace stipple::las
