#include "octree/read/las/las_header_block.h"

#include <cstring>
#include <limits>
#include <string_view>

namespace stipple::las {
namespace {

constexpr std::size_t kLegacyReturns = 5;

class Block {
 public:
  template <class T>
  void put(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof value);
  }
  void put_text(std::size_t offset, std::string_view text) {
    std::memcpy(bytes_.data() + offset, text.data(), text.size());
  }
  const std::array<std::byte, kWrittenHeaderSize>& bytes() const { return bytes_; }

 private:
  std::array<std::byte, kWrittenHeaderSize> bytes_{};
};

void put_counts(const HeaderContent& content, Block& block) {
  block.put(kPointCount, content.point_count);
  for (std::size_t r = 0; r < kMaxReturns; ++r)
    block.put(kCountsByReturn + r * sizeof(std::uint64_t), content.counts_by_return[r]);

  if (content.point_count > std::numeric_limits<std::uint32_t>::max()) return;
  block.put(kLegacyPointCount, static_cast<std::uint32_t>(content.point_count));
  for (std::size_t r = 0; r < kLegacyReturns; ++r)
    block.put(kLegacyCountsByReturn + r * sizeof(std::uint32_t),
              static_cast<std::uint32_t>(content.counts_by_return[r]));
}

}  // namespace

std::array<std::byte, kWrittenHeaderSize> header_block(const HeaderContent& content) {
  Block block;
  block.put_text(kSignature, "LASF");
  block.put<std::uint8_t>(kVersionMajor, 1);
  block.put<std::uint8_t>(kVersionMinor, 4);
  block.put_text(kSystemIdentifier, "OTHER");
  block.put_text(kGeneratingSoftware, "stipple");
  block.put(kHeaderSize, static_cast<std::uint16_t>(kWrittenHeaderSize));
  block.put(kOffsetToPoints, static_cast<std::uint32_t>(kWrittenHeaderSize));
  block.put(kPointFormat, static_cast<std::uint8_t>(content.point_format));
  block.put(kRecordLength, static_cast<std::uint16_t>(record_size(content.point_format)));
  put_counts(content, block);

  const WorldBox bounds = content.bounds.empty() ? WorldBox{glm::dvec3(0.0), glm::dvec3(0.0)} : content.bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t step = static_cast<std::size_t>(axis) * sizeof(double);
    block.put(kScale + step, content.grid.scale[axis]);
    block.put(kOffset + step, content.grid.offset[axis]);
    block.put(kBounds + 2 * step, bounds.max[axis]);
    block.put(kBounds + 2 * step + sizeof(double), bounds.min[axis]);
  }
  return block.bytes();
}

}  // namespace stipple::las
