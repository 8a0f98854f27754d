// Nodes packed by Zstandard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "octree/core/buffer.h"

namespace stipple::ept {

// What the first bytes of a node say of its size once unpacked; nothing when they do not say.
std::optional<std::uint64_t> unpacked_bytes(std::span<const std::byte> begin);
inline constexpr std::size_t kFrameHeaderBytes = 18;  // that unpacked_bytes() looks at, at most

// Throws Error, whose message is for a sentence that names the file, when `packed` does not unpack to exactly `bytes`.
Buffer<std::byte> unpack(std::span<const std::byte> packed, std::uint64_t bytes);

}  // namespace stipple::ept
