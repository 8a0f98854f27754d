#include "octree/read/open.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "octree/core/error.h"
#include "octree/read/input_file.h"
#include "octree/read/las/las_source.h"
#include "octree/read/laz/laz_source.h"
#include "octree/read/obj/obj_source.h"
#include "octree/read/pcd/pcd_header.h"
#include "octree/read/pcd/pcd_source.h"
#include "octree/read/ply/ply_header.h"
#include "octree/read/ply/ply_source.h"
#include "octree/read/text/text_source.h"

namespace stipple {
namespace {

constexpr std::string_view kWhatIsRead =
    "LAS or LAZ 1.0-1.5 with point formats 0-10, PLY, PCD, OBJ, or text with x, y and z in each line";

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
  const InputFile file(path);
  std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kTextStart)), '\0');
  if (start.empty())
    throw file_error(path, 0,
                     fmt::format("the file is empty, and {} was expected. Copy or download it again.", kWhatIsRead));
  file.read_at(0, std::as_writable_bytes(std::span(start)));

  if (start.starts_with("LASF")) {
    if (is_compressed(file)) return std::make_unique<LazSource>(path);
    return std::make_unique<LasSource>(path);
  }
  if (ply::begins_ply(start)) return open_ply(path);
  if (pcd::begins_pcd(start)) return open_pcd(path);
  if (begins_obj(start)) return open_obj(path);
  // Last, as anything may look like it
  if (const auto text = read_start(start)) return open_text(path, *text);
  throw file_error(path, 0,
                   fmt::format("the file begins with {}, which is no point cloud that is read: {}. Convert it, "
                               "or check the path.",
                               describe(std::as_bytes(std::span(start)).first(std::min<std::size_t>(start.size(), 8))),
                               kWhatIsRead));
}

}  // namespace stipple
