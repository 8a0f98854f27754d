// What COPC adds to a LAZ file: an octree over its chunks. Source: COPC specification 1.0, "info VLR" and "hierarchy
// VLR". All numbers are little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "octree/store/tree_store.h"

namespace stipple::copc {

inline constexpr std::string_view kUserId = "copc";
inline constexpr std::uint16_t kInfoRecord = 1;
inline constexpr std::size_t kInfoRecordAt = 375;  // the first behind the header of LAS 1.4

// The info record.
struct Info {
  glm::dvec3 center{0.0};
  double half_edge = 0.0;       // of the root's cube; world units
  double spacing = 0.0;         // of the root's points; world units
  std::uint64_t root_page = 0;  // byte of the file
  std::uint64_t root_page_bytes = 0;
  double gps_time_min = 0.0;
  double gps_time_max = 0.0;
};

inline constexpr std::size_t kInfoBytes = 160;
inline constexpr std::size_t kEntryBytes = 32;  // of a page: i32 level, x, y, z; u64 offset; i32 bytes, points

// `body` stands at byte `offset` of the file `path`. Throws Error when it is too short, or states no cube.
Info parse_info(std::span<const std::byte> body, std::uint64_t offset, const std::string& path);

// Where a page stands.
struct Page {
  std::span<const std::byte> bytes;
  std::uint64_t offset = 0;      // in the file
  std::uint64_t file_bytes = 0;  // of the whole file, which nodes and pages lie within
  const std::string& path;
};

// The nodes of a page, parents before children, whatever their order in the page. It begins with `first`, whose level
// and cell are known. Throws Error naming the byte when an entry is none, occurs twice, has no parent in the page, or
// states bytes that the file does not have.
TreeStore::HierarchyPiece parse_page(const Page& page, const StoredNode& first);

}  // namespace stipple::copc
