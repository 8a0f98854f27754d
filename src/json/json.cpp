#include "src/json/json.h"

#include <fmt/format.h>

#include <cmath>

namespace stipple {

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json json_of(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json json_of(const WorldBox& box) {
  if (box.empty()) return nullptr;
  return {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
}

Json json_of(const Attribute& attribute) {
  return {{"name", attribute.name},
          {"type", name_of(attribute.type)},
          {"components", attribute.components},
          {"scale", attribute.scale},
          {"offset", attribute.offset}};
}

Json json_of_any(double value) {
  if (std::isfinite(value)) return value;
  return fmt::format("{}", value);
}

void print_json(const Json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace stipple
