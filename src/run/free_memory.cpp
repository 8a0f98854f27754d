#include "src/run/free_memory.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace stipple {

std::uint64_t free_memory() {
  std::ifstream info("/proc/meminfo");
  std::string line;
  while (std::getline(info, line))
    if (line.starts_with("MemAvailable:")) return std::strtoull(line.c_str() + 13, nullptr, 10) * 1024;
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace stipple
