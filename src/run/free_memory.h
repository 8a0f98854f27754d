// What the system could still give.
#pragma once

#include <cstdint>

namespace stipple {

// Bytes of main memory that programs may take without others being moved to disk (Linux: MemAvailable). The largest
// number where the system does not say.
std::uint64_t free_memory();

}  // namespace stipple
