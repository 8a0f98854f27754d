// Variable length records, before the points, and extended ones, behind them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/las/las_bytes.h"

namespace stipple::las {

// The places between which records stand and how many are said to.
struct RecordArea {
  std::uint64_t begin = 0;  // byte offset of the first record
  std::uint64_t end = 0;    // no record reaches beyond; at most the file size
  std::uint64_t count = 0;  // as stated
};

// A record and where its body stands.
struct Record {
  std::string user_id;
  std::uint16_t id = 0;
  std::uint64_t begin = 0;  // byte of the file
  std::uint64_t size = 0;
};

// Both walk their chain. One that ends early appends a sentence to `warnings`; what it holds until there is returned.

// Throws Error when a record's body reaches beyond the area.
std::vector<Record> read_vlrs(const FileBytes& file, const RecordArea& area, std::vector<std::string>& warnings);

// `area.begin` may be anywhere.
std::vector<Record> read_evlrs(const FileBytes& file, const RecordArea& area, std::vector<std::string>& warnings);

// The first record of that name; null when there is none.
const Record* find_record(std::span<const Record> records, std::string_view user_id, std::uint16_t id);

}  // namespace stipple::las
