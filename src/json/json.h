// JSON documents as the commands print them.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"

namespace stipple {

// Keys stay in the order in which they were added.
using Json = nlohmann::ordered_json;

// The number; null where there is none.
Json json_of(const std::optional<double>& value);
// [x, y, z]
Json json_of(const glm::dvec3& v);
// {"min": [x, y, z], "max": [x, y, z]}; null for an empty box.
Json json_of(const WorldBox& box);
// {"name", "type", "components", "scale", "offset"}
Json json_of(const Attribute& attribute);
// The number, or "inf", "-inf", "nan": JSON itself has none of the three.
Json json_of_any(double value);

// Prints the document to stdout, indented. Bytes that are not UTF-8 (in paths) become U+FFFD.
void print_json(const Json& document);

}  // namespace stipple
