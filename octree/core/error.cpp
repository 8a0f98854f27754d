#include "octree/core/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace stipple {

Error file_error(std::string_view path, std::uint64_t byte_offset, std::string_view what) {
  return Error(fmt::format("{}: at byte {}: {}", path, byte_offset, what));
}

Error system_error(std::string_view path, std::string_view what) {
  return Error(fmt::format("{}: {}: {}", path, what, std::generic_category().message(errno)));
}

}  // namespace stipple
