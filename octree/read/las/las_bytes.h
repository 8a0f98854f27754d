// Checked access to the bytes of a LAS file that may be anything at all.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "octree/core/error.h"

namespace stipple::las {

// The file's bytes and its name for messages. Does not own either.
struct FileBytes {
  std::span<const std::byte> bytes;
  std::string_view path;

  std::uint64_t size() const { return bytes.size(); }

  Error error_at(std::uint64_t offset, std::string_view what) const { return file_error(path, offset, what); }

  // The T at `offset`. Throws Error when the file ends before it does.
  template <class T>
  T at(std::uint64_t offset) const {
    T value;
    std::memcpy(&value, range(offset, sizeof value).data(), sizeof value);
    return value;
  }

  // Bytes [offset, offset + count). Throws Error when the file ends before they do.
  std::span<const std::byte> range(std::uint64_t offset, std::uint64_t count) const {
    if (offset > size() || count > size() - offset)
      throw error_at(size(), fmt::format("the file ends here, and {} bytes from byte {} on were expected. It was cut "
                                         "off; copy or download it again.",
                                         count, offset));
    return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(count));
  }

  // A fixed-size text field: what stands before the first zero.
  std::string_view text(std::uint64_t offset, std::size_t capacity) const {
    const std::span<const std::byte> field = range(offset, capacity);
    const std::string_view padded(reinterpret_cast<const char*>(field.data()), field.size());
    return padded.substr(0, padded.find('\0'));
  }
};

}  // namespace stipple::las
