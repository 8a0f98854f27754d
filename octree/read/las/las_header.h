// Reads everything in a LAS file that is not a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/grid.h"
#include "octree/cloud/source.h"
#include "octree/read/las/las_format.h"
#include "octree/read/las/las_records.h"

namespace stipple::las {

// What it takes to decode the points. Invariant: points_begin + point_count * record_length is within the file unless
// they are compressed; points_begin and all records are; and every field lies within its record.
struct Header {
  int version_minor = 0;           // of version 1.x: 0 to 5
  int point_format = 0;            // 0 to 10
  bool compressed = false;         // LAZ: the records are not as they stand in the file, see laz/laz_format.h
  std::size_t record_length = 20;  // bytes from one point to the next; 20 to 65,535
  std::uint64_t points_begin = 0;  // byte offset of the first point
  std::uint64_t point_count = 0;
  Grid grid;
  WorldBox stated_bounds;             // as stated, unchecked against the points; empty when no box at all
  std::vector<Field> fields;          // the format's own, then extra bytes
  std::vector<Record> records;        // variable length, before the points, then extended, behind them
  std::vector<std::string> warnings;  // oddities that lose no point, in sentences

  // Of points that are not compressed.
  std::uint64_t points_end() const { return points_begin + point_count * record_length; }
};

// Parses the header of the LAS or LAZ file whose bytes are `file`; `path` is for messages. Pure: touches nothing but
// the span, of which it reads the header, the variable length records and the extended ones, but never a point. Time
// and memory are bounded by the bytes that are there, whatever counts they claim.
//
// Throws Error naming path, byte, what was found, what was expected and what to do when
// - the file ends before the header or before the last point,
// - signature, version or point format are none that is read,
// - header size, offset to points, record length or scale and offset cannot be,
// - a variable length record reaches into the points, so that one of the two is not where it is said to be,
// - the 32-bit and the 64-bit number of points contradict each other.
// A number of variable length records that the header has no room for, extended records that are not where they are
// said to be, and extra bytes described wrongly lose no point: they become warnings.
Header parse_header(std::span<const std::byte> file, std::string_view path);

// The header as a source states it. `format` is the name of the format, "LAS".
SourceInfo source_info(const Header& header, const std::string& path, std::string format);

}  // namespace stipple::las
