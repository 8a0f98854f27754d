// 8-bit RGB pictures and PNG files.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "render/frame/frame_data.h"

namespace stipple {

struct Image {
  glm::ivec2 size{0};
  std::vector<std::uint8_t> rgb;  // 3 bytes a pixel, row by row, row 0 at the top
};

// Pixels without a point get `background` (0xRRGGBB).
Image compose(const FrameData& frame, std::uint32_t background);

// Keyword (1 to 79 Latin-1 characters) to text (UTF-8), kept as PNG tEXt chunks, iTXt where the text is not ASCII:
// provenance travels with the picture.
using ImageText = std::map<std::string, std::string>;

// Throws Error when the file cannot be written; a failed write leaves no file behind, nor does it touch an older one.
void write_png(const std::string& path, const Image& image, const ImageText& text = {});
// What a PNG file of it would hold, smaller than write_png() makes it in less time.
std::string png_bytes(const Image& image);
// Throws Error when the file is missing, not a whole valid PNG, or has a side above 16384 pixels. Alpha is dropped,
// grey and palette become RGB, 16 bits become 8.
Image read_png(const std::string& path);

}  // namespace stipple
