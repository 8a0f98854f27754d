// Numbers written out in decimal.
#pragma once

#include <cstddef>

#include "octree/cloud/attribute.h"

namespace stipple {

// Reads the number that begins at `at` into `value`, correctly rounded; "nan" and "inf" in the spellings of C and of
// Microsoft's C library are numbers, too, and so is a "+" before one. Returns where it ends, or null when there is
// none.
const char* parse_number(const char* at, const char* end, double& value);

// Reads the number that begins at `at` as one of type `type` and stores it at `out`. Whole numbers may be written as
// "7.0", and those of one or two bytes signed or not: -1 is 255 then. Returns where it ends, or null when there is none
// or it does not fit.
const char* parse_as(ScalarType type, const char* at, const char* end, std::byte* out);

}  // namespace stipple
