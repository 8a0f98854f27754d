#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "octree/store/potree1/format.h"

namespace stipple::potree1 {
namespace {

constexpr std::uint64_t kMaxComponents = 1 << 16;
constexpr std::size_t kMaxRowBytes = 1 << 20;
constexpr std::size_t kMaxAttributes = 1000;

// An attribute as the row has it.
struct Stored {
  std::string name;  // in capitals, with underscores
  ScalarType type = ScalarType::u8;
  std::uint64_t elements = 1;
  std::uint64_t bytes = 0;
};

// What the names of versions 1.4 to 1.7 stand for. Source: Potree 1.6, src/loader/PointAttributes.js.
const Stored kNamed[] = {
    {"POSITION_CARTESIAN", ScalarType::i32, 3, 12},
    {"COLOR_PACKED", ScalarType::u8, 4, 4},
    {"RGBA_PACKED", ScalarType::u8, 4, 4},
    {"RGBA", ScalarType::u8, 4, 4},
    {"RGB_PACKED", ScalarType::u8, 3, 3},
    {"RGB", ScalarType::u8, 3, 3},
    {"NORMAL_SPHEREMAPPED", ScalarType::u8, 2, 2},
    {"NORMAL_OCT16", ScalarType::u8, 2, 2},
    {"NORMAL", ScalarType::f32, 3, 12},
    {"NORMAL_FLOATS", ScalarType::f32, 3, 12},
    {"INTENSITY", ScalarType::u16, 1, 2},
    {"CLASSIFICATION", ScalarType::u8, 1, 1},
    {"RETURN_NUMBER", ScalarType::u8, 1, 1},
    {"NUMBER_OF_RETURNS", ScalarType::u8, 1, 1},
    {"SOURCE_ID", ScalarType::u16, 1, 2},
    {"GPS_TIME", ScalarType::f64, 1, 8},
    {"INDICES", ScalarType::u32, 1, 4},
    {"SPACING", ScalarType::f32, 1, 4},
};

// "gps-time" and "GPS_TIME" are one.
std::string capitals(std::string_view name) {
  std::string result(name);
  for (char& c : result)
    c = c == '-' || c == ' ' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::string our_name(const std::string& capital, const std::string& own) {
  static const std::pair<std::string_view, std::string_view> kNames[] = {
      {"INTENSITY", "intensity"},
      {"CLASSIFICATION", "classification"},
      {"RETURN_NUMBER", "return number"},
      {"NUMBER_OF_RETURNS", "number of returns"},
      {"SOURCE_ID", "point source id"},
      {"POINT_SOURCE_ID", "point source id"},
      {"GPS_TIME", "gps-time"},
      {"USER_DATA", "user data"},
      {"SCAN_ANGLE", "scan angle"},
      {"SCAN_ANGLE_RANK", "scan angle"},
      {"NORMAL", "normal"},
      {"NORMAL_FLOATS", "normal"},
  };
  const auto found = std::ranges::find(kNames, capital, [](const auto& pair) { return pair.first; });
  return found == std::end(kNames) ? own : std::string(found->second);
}

Stored parse_name(const JsonValue& json) {
  const auto found = std::ranges::find(kNamed, capitals(json.text()), &Stored::name);
  if (found == std::end(kNamed))
    throw json.error(fmt::format("\"{}\" is no attribute of Potree 1 whose size is known.", json.text()));
  return *found;
}

// 1.8: {"name": "gps-time", "size": 8, "elements": 1, "elementSize": 8, "type": "double"}. Where there is no type, the
// name tells; bytes of a name that does not stay bytes.
Stored parse_object(const JsonValue& json) {
  Stored stored;
  stored.name = capitals(json["name"].text());
  stored.bytes = json["size"].whole(1, kMaxRowBytes);
  if (!json.find("type")) {
    const auto named = std::ranges::find(kNamed, stored.name, &Stored::name);
    if (named != std::end(kNamed) && named->bytes == stored.bytes) return *named;
    stored.elements = stored.bytes;
    return stored;
  }
  stored.elements = json["elements"].whole(1, kMaxComponents);
  stored.type = json["type"].scalar_type();
  if (stored.bytes != stored.elements * size_of(stored.type))
    throw json["size"].error(fmt::format("{} bytes, and {} were expected for {} x {}.", stored.bytes,
                                         stored.elements * size_of(stored.type), stored.elements,
                                         name_of(stored.type)));
  return stored;
}

bool is_colour(const Stored& stored) {
  const bool named = stored.name.starts_with("RGB") || stored.name == "COLOR_PACKED";
  return named && (stored.elements == 3 || stored.elements == 4) &&
         (stored.type == ScalarType::u8 || stored.type == ScalarType::u16);
}

// Alpha is left out: it says nothing.
RowField field_of(const Stored& stored, const std::string& own_name, std::size_t place) {
  RowField field;
  const bool colour = is_colour(stored);
  const std::size_t components = colour ? 3 : stored.elements;
  field.attribute = {colour ? "rgb" : our_name(stored.name, own_name), colour ? ScalarType::u16 : stored.type,
                     static_cast<int>(components), 1.0, 0.0};
  field.widened = colour && stored.type == ScalarType::u8;
  for (std::size_t c = 0; c < components; ++c) field.offsets.push_back(place + c * size_of(stored.type));
  return field;
}

}  // namespace

void parse_attributes(const JsonValue& json, Metadata& metadata) {
  bool has_position = false;
  const std::vector<JsonValue> elements = json.elements();
  if (elements.size() > kMaxAttributes)
    throw json.error(fmt::format("{} attributes, and at most {} are read.", elements.size(), kMaxAttributes));
  for (const JsonValue& element : elements) {
    const bool object = element.is_object();
    const Stored stored = object ? parse_object(element) : parse_name(element);
    const std::size_t place = metadata.rows.bytes;
    metadata.rows.bytes += stored.bytes;
    if (metadata.rows.bytes > kMaxRowBytes)
      throw json.error(fmt::format("the attributes take more than {} bytes a point; fewer are read.", kMaxRowBytes));
    if (!stored.name.starts_with("POSITION")) {
      RowField field = field_of(stored, object ? element["name"].text() : element.text(), place);
      if (find_attribute(metadata.rows.schema(), field.attribute.name))
        throw element.error(fmt::format("\"{}\" was there already, and is expected once.", field.attribute.name));
      metadata.rows.fields.push_back(std::move(field));
      continue;
    }
    if (has_position || stored.elements != 3 || stored.type != ScalarType::i32)
      throw element.error("one position of 3 x int32 was expected.");
    has_position = true;
    metadata.position_place = place;
  }
  if (!has_position) throw json.error("POSITION_CARTESIAN was expected among them.");
}

}  // namespace stipple::potree1
