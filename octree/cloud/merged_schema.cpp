#include "octree/cloud/merged_schema.h"

#include <algorithm>

namespace stipple {

Schema merged_schema(std::span<const std::unique_ptr<PointSource>> sources) {
  Schema schema;
  for (const auto& source : sources)
    for (const Attribute& attribute : source->info().schema) {
      const auto known = find_attribute(schema, attribute.name);
      if (!known) {
        schema.push_back(attribute);
      } else if (schema[*known] != attribute) {
        Attribute& common = schema[*known];
        common = {common.name, ScalarType::f64, std::max(common.components, attribute.components), 1.0, 0.0};
      }
    }
  return schema;
}

Column converted(const Column& column, const Attribute& common) {
  Column result{common, {}};
  result.resize(column.points());
  const std::span<double> values = result.as<double>();
  const auto components = static_cast<std::size_t>(common.components);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto c = static_cast<int>(i % components);
    values[i] = c < column.attribute.components ? value_at(column, i / components, c) : 0.0;
  }
  return result;
}

Column zeros(const Attribute& attribute, std::size_t points) {
  Column column{attribute, {}};
  column.resize(points);
  std::ranges::fill(column.bytes, std::byte{0});
  return column;
}

}  // namespace stipple
