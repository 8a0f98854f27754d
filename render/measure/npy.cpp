#include "render/measure/npy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>

#include "octree/core/output_file.h"

namespace stipple {
namespace {

static_assert(std::endian::native == std::endian::little);

// NEP 1: magic, version, length of the header, header padded with spaces so that the data start at a multiple of 64.
std::string header_of(std::string_view type, const std::vector<std::size_t>& shape) {
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, fmt::join(shape, ", "));
  constexpr std::size_t kPreamble = 10;
  dictionary.append(63 - (kPreamble + dictionary.size()) % 64, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 0xFF);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

void write(const std::string& path, const std::string& header, std::span<const std::byte> values) {
  OutputFile file(path);
  file.write_at(0, std::as_bytes(std::span(header)));
  file.write_at(header.size(), values);
  file.commit();
}

}  // namespace

void write_npy(const std::string& path, std::span<const float> values, const std::vector<std::size_t>& shape) {
  write(path, header_of("<f4", shape), std::as_bytes(values));
}

void write_npy(const std::string& path, std::span<const double> values, const std::vector<std::size_t>& shape) {
  write(path, header_of("<f8", shape), std::as_bytes(values));
}

}  // namespace stipple
