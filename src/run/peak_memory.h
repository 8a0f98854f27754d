// What the process has had resident at most.
#pragma once

#include <cstdint>

namespace stipple {

// Bytes, of this program alone: getrusage() would count what the program that started it had resident, too. 0 where the
// system does not say.
std::uint64_t peak_memory();

}  // namespace stipple
