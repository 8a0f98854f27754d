// Everything that a path leads to, read as users read it.
#pragma once

#include <string>

namespace stipple::fuzz {

// Opens and reads all points, with all attributes and with none; of a tree also node by node, in parts and with
// details. Throws Error as those do. Aborts when without an Error what was read is not what was announced.
void read_all(const std::string& path);

}  // namespace stipple::fuzz
