#include "octree/store/ept/zstandard.h"

#include <fmt/format.h>
#include <zstd.h>

#include "octree/core/error.h"

namespace stipple::ept {

std::optional<std::uint64_t> unpacked_bytes(std::span<const std::byte> begin) {
  const unsigned long long bytes = ZSTD_getFrameContentSize(begin.data(), begin.size());
  if (bytes == ZSTD_CONTENTSIZE_UNKNOWN || bytes == ZSTD_CONTENTSIZE_ERROR) return std::nullopt;
  return bytes;
}

Buffer<std::byte> unpack(std::span<const std::byte> packed, std::uint64_t bytes) {
  Buffer<std::byte> unpacked(static_cast<std::size_t>(bytes));
  const std::size_t size = ZSTD_decompress(unpacked.data(), unpacked.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) || size != unpacked.size())
    throw Error(fmt::format("they are no Zstandard stream that unpacks to {} bytes", bytes));
  return unpacked;
}

}  // namespace stipple::ept
