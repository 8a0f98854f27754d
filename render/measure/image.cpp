#include "render/measure/image.h"

namespace stipple {

Image compose(const FrameData& frame, std::uint32_t background) {
  Image image{frame.size, std::vector<std::uint8_t>(frame.pixels() * 3)};
  const std::uint32_t background_bgr = (background & 0xFFu) << 16 | (background & 0xFF00u) | (background >> 16 & 0xFFu);
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    const std::uint32_t bgr = frame.ids[i] == kNoPoint ? background_bgr : frame.rgba[i];
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = static_cast<std::uint8_t>(bgr >> (8 * c));
  }
  return image;
}

}  // namespace stipple
