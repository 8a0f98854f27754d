// Extra bytes: attributes that a file adds to those of its point format.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octree/read/las/las_format.h"

namespace stipple::las {

// Appends to `fields` what stands in bytes [begin, end) of each record. `description` is the body of the record
// "Extra Bytes" (LAS 1.4 R15, table "Extra Bytes Descriptor": 192 bytes an attribute), if there is one.
//
// Names are kept as given, unless they are empty ("extra bytes"), no UTF-8 (the odd bytes become '?') or taken (" 2",
// " 3", ... is appended). Data types 11 to 30, deprecated arrays of two or three, become one attribute of as many
// components, or, where the components differ in scale or offset, one attribute each: "NAME[0]", "NAME[1]", ...
// Undocumented bytes (type 0) are u8. What the description leaves over becomes one u8 x n attribute "extra bytes".
// A description that asks for more bytes than there are, or for a type that does not exist, cannot be trusted in any
// part: all bytes become "extra bytes" then, and a sentence is appended to `warnings`.
void append_extra_bytes(std::optional<std::span<const std::byte>> description, std::size_t begin, std::size_t end,
                        std::vector<Field>& fields, std::vector<std::string>& warnings);

}  // namespace stipple::las
