// Arrays for other programs: NumPy's .npy files, format version 1.0.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace stipple {

// Row-major array of this shape, little-endian. Throws Error when the file cannot be written; a failed write leaves no
// file behind.
void write_npy(const std::string& path, std::span<const float> values, const std::vector<std::size_t>& shape);
void write_npy(const std::string& path, std::span<const double> values, const std::vector<std::size_t>& shape);

}  // namespace stipple
