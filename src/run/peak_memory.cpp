#include "src/run/peak_memory.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace stipple {

std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.starts_with("VmHWM:")) return std::strtoull(line.c_str() + 6, nullptr, 10) * 1024;
  return 0;
}

}  // namespace stipple
