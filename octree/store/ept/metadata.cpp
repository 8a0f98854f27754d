#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "octree/store/ept/format.h"
#include "octree/store/json_cube.h"

namespace stipple::ept {
namespace {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 48;
constexpr std::size_t kMaxDimensions = 1000;
// Steps of the grid of X, Y and Z that are no integers: an edge of 2^30 leaves a bit for points outside the cube.
constexpr int kRealGridBits = 30;

// One dimension of the schema.
struct Dimension {
  std::string name;
  ScalarType type = ScalarType::u8;
  std::size_t place = 0;  // byte of the row
  double scale = 1.0;
  double offset = 0.0;
  AttributeRange range;
};

// PDAL's names of what has a name here.
std::string_view our_name(std::string_view dimension) {
  static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"Intensity", "intensity"},
      {"ReturnNumber", "return number"},
      {"NumberOfReturns", "number of returns"},
      {"ScanDirectionFlag", "scan direction flag"},
      {"EdgeOfFlightLine", "edge of flight line"},
      {"Classification", "classification"},
      {"ClassFlags", "classification flags"},
      {"ScanChannel", "scanner channel"},
      {"ScanAngleRank", "scan angle"},
      {"ScanAngle", "scan angle"},
      {"UserData", "user data"},
      {"PointSourceId", "point source id"},
      {"GpsTime", "gps-time"},
      {"Infrared", "nir"},
  };
  const auto found = std::ranges::find(kNames, dimension, [](const auto& pair) { return pair.first; });
  return found == std::end(kNames) ? dimension : found->second;
}

ScalarType parse_type(const JsonValue& json) {
  const std::string& kind = json["type"].text();
  const std::uint64_t size = json["size"].whole(1, 8);
  static const std::map<std::pair<std::string, std::uint64_t>, ScalarType> kTypes{
      {{"unsigned", 1}, ScalarType::u8},  {{"unsigned", 2}, ScalarType::u16}, {{"unsigned", 4}, ScalarType::u32},
      {{"unsigned", 8}, ScalarType::u64}, {{"signed", 1}, ScalarType::i8},    {{"signed", 2}, ScalarType::i16},
      {{"signed", 4}, ScalarType::i32},   {{"signed", 8}, ScalarType::i64},   {{"float", 4}, ScalarType::f32},
      {{"float", 8}, ScalarType::f64}};
  const auto found = kTypes.find({kind, size});
  if (found == kTypes.end())
    throw json["type"].error(fmt::format(
        "\"{}\" of {} bytes, and signed or unsigned of 1, 2, 4 or 8, or float of 4 or 8 was expected.", kind, size));
  return found->second;
}

double number_or(const JsonValue& json, std::string_view key, double otherwise) {
  const auto found = json.find(key);
  return found ? found->number() : otherwise;
}

Dimension parse_dimension(const JsonValue& json, std::size_t place) {
  Dimension dimension;
  dimension.name = json["name"].text();
  dimension.type = parse_type(json);
  dimension.place = place;
  dimension.scale = number_or(json, "scale", 1.0);
  dimension.offset = number_or(json, "offset", 0.0);
  if (!(dimension.scale > 0.0)) throw json["scale"].error("a number above 0 was expected.");
  const auto low = json.find("minimum"), high = json.find("maximum");
  if (low && high) dimension.range = {{low->number_or_nan()}, {high->number_or_nan()}, {}};
  return dimension;
}

std::vector<Dimension> parse_dimensions(const JsonValue& json, RowLayout& rows) {
  std::vector<Dimension> dimensions;
  const std::vector<JsonValue> elements = json.elements();
  if (elements.size() > kMaxDimensions)
    throw json.error(fmt::format("{} dimensions, and at most {} are read.", elements.size(), kMaxDimensions));
  for (const JsonValue& element : elements) {
    dimensions.push_back(parse_dimension(element, rows.bytes));
    rows.bytes += size_of(dimensions.back().type);
  }
  return dimensions;
}

const Dimension* find(const std::vector<Dimension>& dimensions, std::string_view name) {
  const auto found = std::ranges::find(dimensions, name, &Dimension::name);
  return found == dimensions.end() ? nullptr : &*found;
}

void append_range(AttributeRange& range, const AttributeRange& component) {
  range.min.insert(range.min.end(), component.min.begin(), component.min.end());
  range.max.insert(range.max.end(), component.max.begin(), component.max.end());
}

// Red, Green and Blue as one attribute, if they are all there and of one type of 8 or 16 bits.
bool append_rgb(const std::vector<Dimension>& dimensions, Metadata& metadata) {
  RowField field;
  field.attribute = {"rgb", ScalarType::u16, 3, 1.0, 0.0};
  AttributeRange range;
  for (const char* name : {"Red", "Green", "Blue"}) {
    const Dimension* channel = find(dimensions, name);
    if (!channel || channel->type != find(dimensions, "Red")->type) return false;
    field.widened = channel->type == ScalarType::u8;
    if (channel->type != ScalarType::u16 && !field.widened) return false;
    field.offsets.push_back(channel->place);
    append_range(range, channel->range);
  }
  metadata.rows.fields.push_back(field);
  metadata.ranges.push_back(range);
  return true;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

void take_fields(const std::vector<Dimension>& dimensions, Metadata& metadata) {
  bool has_rgb = false;
  for (const Dimension& dimension : dimensions) {
    if (is_one_of(dimension.name, {"X", "Y", "Z"})) continue;
    if (dimension.name == "Red") has_rgb = append_rgb(dimensions, metadata);
    if (has_rgb && is_one_of(dimension.name, {"Red", "Green", "Blue"})) continue;
    RowField field;
    field.attribute = {std::string(our_name(dimension.name)), dimension.type, 1, dimension.scale, dimension.offset};
    // Two dimensions may mean one attribute: the second keeps its own name
    if (find_attribute(metadata.rows.schema(), field.attribute.name)) field.attribute.name = dimension.name;
    field.offsets = {dimension.place};
    metadata.rows.fields.push_back(std::move(field));
    metadata.ranges.push_back(dimension.range);
  }
}

// The axis and its part of the grid. Integers keep their steps; what has more bits than the grid counts from the middle
// of the cube.
void take_axis(int axis, const Dimension& dimension, Metadata& metadata) {
  Axis& result = metadata.axes[static_cast<std::size_t>(axis)];
  result = {dimension.place, dimension.type, dimension.scale, dimension.offset, 0};
  double& scale = metadata.grid.scale[axis];
  double& offset = metadata.grid.offset[axis];
  const double middle = 0.5 * metadata.cube.min[axis] + 0.5 * metadata.cube.max[axis];
  if (result.is_real()) {
    const double edge = std::max(metadata.cube.max[axis] - metadata.cube.min[axis], 1e-300);
    // A power of two: sums and products with it are exact, so that float values keep their bits
    scale = std::exp2(std::ceil(std::log2(edge)) - kRealGridBits);
    offset = std::round(middle / scale) * scale;
    return;
  }
  scale = result.scale;
  offset = result.offset;
  const bool fits = result.type == ScalarType::i32 || size_of(result.type) < 4;
  if (fits) return;
  constexpr double kMostSteps = 1e18;
  const double steps = std::round((middle - offset) / scale);
  result.base = std::abs(steps) < kMostSteps ? static_cast<std::int64_t>(steps) : 0;
  offset += scale * static_cast<double>(result.base);
}

void parse_schema(const JsonValue& json, Metadata& metadata) {
  const std::vector<Dimension> dimensions = parse_dimensions(json, metadata.rows);
  for (int axis = 0; axis < 3; ++axis) {
    const Dimension* dimension = find(dimensions, std::string(1, "XYZ"[axis]));
    if (!dimension) throw json.error(fmt::format("there is no dimension {}, which was expected.", "XYZ"[axis]));
    take_axis(axis, *dimension, metadata);
  }
  take_fields(dimensions, metadata);
}

WorldBox parse_box(const JsonValue& json) {
  const std::vector<JsonValue> values = json.elements(6);
  WorldBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = values[static_cast<std::size_t>(axis)].number();
    box.max[axis] = values[static_cast<std::size_t>(axis) + 3].number();
    if (!(box.min[axis] <= box.max[axis]))
      throw json.error("minima of x, y and z and then maxima were expected, none below its minimum.");
  }
  return box;
}

WorldBox parse_cube(const JsonValue& json) {
  const WorldBox box = parse_box(json);
  check_cube(box, json);
  return box;
}

DataType parse_data_type(const JsonValue& json) {
  const std::string& name = json.text();
  if (name == "laszip") return DataType::laszip;
  if (name == "binary") return DataType::binary;
  if (name == "zstandard") return DataType::zstandard;
  throw json.error(fmt::format("\"{}\" was found, and laszip, binary or zstandard was expected.", name));
}

}  // namespace

Metadata parse_metadata(const std::string& text, const std::string& path) {
  const auto document = parse_json(text, path);
  const JsonValue json(document, path);
  Metadata metadata;
  metadata.version = json["version"].text();
  if (metadata.version != "0.0.0" && !metadata.version.starts_with("1."))
    throw json["version"].error(fmt::format("\"{}\" was found, and 1.0.0 or 1.1.0 was expected.", metadata.version));
  metadata.data_type = parse_data_type(json["dataType"]);
  if (const auto type = json.find("hierarchyType"); type && type->text() != "json")
    throw type->error(fmt::format("\"{}\" was found, and json was expected.", type->text()));
  metadata.points = json["points"].whole(0, kMaxPoints);
  metadata.cube = parse_cube(json["bounds"]);
  if (const auto box = json.find("boundsConforming")) metadata.conforming = parse_box(*box);
  metadata.span = number_or(json, "span", 0.0);
  if (metadata.span < 0.0) throw json["span"].error("0 or more was expected.");
  parse_schema(json["schema"], metadata);
  return metadata;
}

}  // namespace stipple::ept
