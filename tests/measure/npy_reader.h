// Reads .npy files by the text of NEP 1, independently of the writer.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace stipple::test {

struct NpyFile {
  std::string header;          // the dictionary, newline included
  std::size_t data_begin = 0;  // bytes
  std::string bytes;           // the whole file

  template <class T>
  std::vector<T> values() const {
    std::vector<T> out((bytes.size() - data_begin) / sizeof(T));
    std::memcpy(out.data(), bytes.data() + data_begin, out.size() * sizeof(T));
    return out;
  }
};

inline NpyFile read_npy(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  NpyFile file;
  file.bytes = {std::istreambuf_iterator<char>(in), {}};
  if (file.bytes.size() < 10) {
    ADD_FAILURE() << path << " is missing or too short";
    return file;
  }
  EXPECT_EQ(file.bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const auto length = static_cast<std::size_t>(static_cast<unsigned char>(file.bytes[8])) +
                      256 * static_cast<std::size_t>(static_cast<unsigned char>(file.bytes[9]));
  file.data_begin = 10 + length;
  file.header = file.bytes.substr(10, length);
  return file;
}

}  // namespace stipple::test
