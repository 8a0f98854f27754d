// What the columns of a table mean, told by their names.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/table/point_table.h"

namespace stipple {

// One component of a field.
struct FieldPart {
  std::size_t field = 0;
  int component = 0;
};

// How an attribute is made of fields.
struct Derivation {
  enum class Kind {
    copy,          // the field itself
    color,         // three numbers: "rgb", 16 bits a channel
    packed_color,  // the lower three bytes of a 32-bit field, red highest: "rgb"
    packed_alpha,  // the upper one: "alpha"
  };
  Attribute attribute;
  Kind kind = Kind::copy;
  std::array<FieldPart, 3> parts{};  // only color uses more than the first
};

struct TableMeaning {
  std::array<std::optional<std::size_t>, 3> position;  // fields; z may be missing, it is 0 then
  std::vector<Derivation> attributes;                  // every other field, in the order of the file
};

// Whether a field of that name is x, y or z: in any letter case.
bool is_coordinate(std::string_view name);

// Names are compared without case, "scalar_" before a name is left out, and what Potree 2.0 has a name for gets it:
// "intensity" also for reflectance, "gps-time" also for GpsTime, and so on. Colours are red, green and blue; r, g and
// b; the same with "diffuse_" before; rgb or rgba of one 32-bit number or of 3 components. Fields called "_" are
// padding. Throws Error, saying `place`, when there is no x or no y.
TableMeaning meaning_of(const std::vector<TableField>& fields, const std::string& place);

}  // namespace stipple
