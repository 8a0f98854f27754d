#include "octree/read/open.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "octree/core/error.h"
#include "octree/read/input_file.h"
#include "octree/read/las/las_source.h"
#include "octree/read/laz/laz_source.h"

namespace stipple {
namespace {

constexpr std::string_view kWhatIsRead = "LAS and LAZ 1.0-1.5, point formats 0-10";

// "4c 41 53 46 (LASF)"; what is no printable ASCII shows as a dot.
std::string describe(std::span<const std::byte> bytes) {
  std::string hex, text;
  for (const std::byte byte : bytes) {
    const auto value = std::to_integer<unsigned char>(byte);
    hex += fmt::format("{}{:02x}", hex.empty() ? "" : " ", value);
    text += value >= 0x20 && value < 0x7F ? static_cast<char>(value) : '.';
  }
  return fmt::format("{} ({})", hex, text);
}

// Whether a file that begins as LAS does is LAZ; whatever its name says. What is cut off before the point format is
// not.
bool is_compressed(const InputFile& file) {
  std::array<std::byte, 1> format{};
  if (file.size() > las::kPointFormat) file.read_at(las::kPointFormat, format);
  return (std::to_integer<int>(format[0]) & las::kCompressed) != 0;
}

}  // namespace

std::unique_ptr<PointSource> open_file(const std::string& path) {
  std::array<std::byte, 8> start{};
  const InputFile file(path);
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), start.size()));
  if (count == 0)
    throw file_error(path, 0,
                     fmt::format("the file is empty, and {} was expected. Copy or download it again.", kWhatIsRead));
  const std::span<std::byte> seen = std::span(start).first(count);
  file.read_at(0, seen);

  if (std::string_view(reinterpret_cast<const char*>(seen.data()), seen.size()).starts_with("LASF")) {
    if (is_compressed(file)) return std::make_unique<LazSource>(path);
    return std::make_unique<LasSource>(path);
  }
  throw file_error(path, 0,
                   fmt::format("the file begins with {}, which is no point cloud that is read: {}. Convert it, "
                               "or check the path.",
                               describe(seen), kWhatIsRead));
}

}  // namespace stipple
