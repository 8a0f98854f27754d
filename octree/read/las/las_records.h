// Variable length records, before the points, and extended ones, behind them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octree/read/las/las_bytes.h"

namespace stipple::las {

// The places between which records stand and how many are said to.
struct RecordArea {
  std::uint64_t begin = 0;  // byte offset of the first record
  std::uint64_t end = 0;    // no record reaches beyond; at most the file size
  std::uint64_t count = 0;  // as stated
};

// Both walk their chain and return the body of the first record that describes extra bytes (user id "LASF_Spec",
// record id 4), the only one that is needed to decode points. A chain that ends early appends a sentence to `warnings`.

// Throws Error when a record's body reaches beyond the area.
std::optional<std::span<const std::byte>> find_extra_bytes_vlr(const FileBytes& file, const RecordArea& area,
                                                               std::vector<std::string>& warnings);

// `area.begin` may be anywhere.
std::optional<std::span<const std::byte>> find_extra_bytes_evlr(const FileBytes& file, const RecordArea& area,
                                                                std::vector<std::string>& warnings);

}  // namespace stipple::las
