// From rows, one record a point, to columns.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "octree/cloud/attribute.h"
#include "octree/read/las/las_format.h"

namespace stipple::las {

// `records` holds out.size() records of `record_length` bytes.
void decode_positions(std::span<const std::byte> records, std::size_t record_length, std::span<glm::ivec3> out);

// Fills `out`, tightly packed values of the field's attribute, from as many records.
void decode_field(const Field& field, std::span<const std::byte> records, std::size_t record_length,
                  std::span<std::byte> out);

}  // namespace stipple::las
