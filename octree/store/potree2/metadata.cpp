#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "octree/store/json_cube.h"
#include "octree/store/potree2/format.h"

namespace stipple::potree2 {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 48;
constexpr std::uint64_t kMaxComponents = 1 << 16;
constexpr std::uint64_t kMaxRecordBytes = 1 << 20;

// The one value that all components share; `otherwise` where the file has no such key.
double common_value(const JsonValue& attribute, std::string_view key, double otherwise) {
  const auto found = attribute.find(key);
  if (!found) return otherwise;
  const std::vector<JsonValue> values = found->elements();
  if (values.empty()) return otherwise;
  for (const JsonValue& value : values)
    if (value.number() != values[0].number())
      throw found->error("the components differ, and the same value for all of them was expected.");
  return values[0].number();
}

Attribute parse_attribute(const JsonValue& json) {
  Attribute attribute;
  attribute.name = json["name"].text();
  attribute.components = static_cast<int>(json["numElements"].whole(1, kMaxComponents));
  const std::string& type = json["type"].text();
  const std::uint64_t size = json["size"].whole(1, kMaxRecordBytes);
  if (type == "undefined") {  // bytes that PotreeConverter could not make sense of
    attribute.components = static_cast<int>(size);
    return attribute;
  }
  attribute.type = json["type"].scalar_type();
  attribute.scale = common_value(json, "scale", 1.0);
  attribute.offset = common_value(json, "offset", 0.0);
  if (size != attribute.bytes())
    throw json["size"].error(fmt::format("{} bytes, and {} were expected for {} x {}.", size, attribute.bytes(),
                                         attribute.components, type));
  return attribute;
}

std::vector<double> parse_limits(const JsonValue& attribute, std::string_view key) {
  std::vector<double> limits;
  if (const auto found = attribute.find(key))
    for (const JsonValue& value : found->elements()) limits.push_back(value.number_or_nan());
  return limits;
}

AttributeRange parse_range(const JsonValue& attribute) {
  AttributeRange range{parse_limits(attribute, "min"), parse_limits(attribute, "max"), {}};
  if (const auto histogram = attribute.find("histogram"))
    for (const JsonValue& count : histogram->elements(256)) range.histogram.push_back(count.whole(0, kMaxPoints));
  return range;
}

void parse_attributes(const JsonValue& json, Metadata& metadata) {
  const std::vector<JsonValue> attributes = json.elements();
  const Attribute wanted{"position", ScalarType::i32, 3, 1.0, 0.0};
  if (attributes.empty() || parse_attribute(attributes[0]) != wanted)
    throw json.error("\"position\", 3 x int32, was expected to come first.");
  std::size_t bytes = wanted.bytes();
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    metadata.ranges.push_back(parse_range(attributes[i]));
    if (i == 0) continue;
    metadata.schema.push_back(parse_attribute(attributes[i]));
    bytes += metadata.schema.back().bytes();
  }
  if (bytes > kMaxRecordBytes)
    throw json.error(fmt::format("{} bytes a point, and at most {} are read.", bytes, kMaxRecordBytes));
}

Grid parse_grid(const JsonValue& json) {
  const Grid grid{json["offset"].vector(), json["scale"].vector()};
  if (!glm::all(glm::greaterThan(grid.scale, glm::dvec3(0.0))))
    throw json["scale"].error("three numbers above 0 were expected.");
  return grid;
}

WorldBox parse_cube(const JsonValue& json) {
  const WorldBox box{json["min"].vector(), json["max"].vector()};
  check_cube(box, json);
  return box;
}

Encoding parse_encoding(const JsonValue& json) {
  const auto found = json.find("encoding");
  if (!found) return Encoding::uncompressed;  // the first converters that wrote 2.0 knew no other
  const std::string& name = found->text();
  if (name == "DEFAULT" || name == "UNCOMPRESSED") return Encoding::uncompressed;
  if (name == "BROTLI") return Encoding::brotli;
  throw found->error(fmt::format("\"{}\" was found, and DEFAULT, UNCOMPRESSED or BROTLI was expected.", name));
}

std::string text_or_empty(const JsonValue& json, std::string_view key) {
  const auto found = json.find(key);
  return found ? found->text() : "";
}

// JSON has no number for "unknown".
Json json_of(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return json;
}

Json json_of(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json json_of(const Attribute& attribute, const AttributeRange& range) {
  const auto components = static_cast<std::size_t>(attribute.components);
  Json json{{"name", attribute.name},
            {"description", ""},
            {"size", attribute.bytes()},
            {"numElements", attribute.components},
            {"elementSize", size_of(attribute.type)},
            {"type", name_of(attribute.type)}};
  if (!range.histogram.empty()) json["histogram"] = range.histogram;
  json["min"] = json_of(range.min);
  json["max"] = json_of(range.max);
  json["scale"] = json_of(std::vector(components, attribute.scale));
  json["offset"] = json_of(std::vector(components, attribute.offset));
  return json;
}

}  // namespace

std::size_t brotli_bytes(const Attribute& attribute) {
  const bool colour = attribute.name == "rgb" || attribute.name == "rgba";
  return colour ? 8 : attribute.bytes();
}

std::size_t record_bytes(const Schema& schema) {
  std::size_t bytes = sizeof(glm::ivec3);
  for (const Attribute& attribute : schema) bytes += attribute.bytes();
  return bytes;
}

Metadata parse_metadata(const std::string& text, const std::string& path) {
  const Json document = parse_json(text, path);
  const JsonValue json(document, path);
  const std::string& version = json["version"].text();
  if (!version.starts_with("2."))
    throw json["version"].error(fmt::format("\"{}\" was found, and 2.0 was expected.", version));

  Metadata metadata;
  metadata.name = text_or_empty(json, "name");
  metadata.description = text_or_empty(json, "description");
  metadata.projection = text_or_empty(json, "projection");
  metadata.points = json["points"].whole(0, kMaxPoints);
  const JsonValue hierarchy = json["hierarchy"];
  metadata.first_piece_bytes = hierarchy["firstChunkSize"].whole(0, kMaxPoints);
  metadata.step_size = static_cast<int>(hierarchy["stepSize"].whole(1, 1000));
  metadata.depth = static_cast<int>(hierarchy["depth"].whole(0, 1000));
  metadata.grid = parse_grid(json);
  metadata.spacing = json["spacing"].number();
  if (metadata.spacing < 0.0) throw json["spacing"].error("0 or more was expected.");
  metadata.cube = parse_cube(json["boundingBox"]);
  metadata.encoding = parse_encoding(json);
  parse_attributes(json["attributes"], metadata);
  return metadata;
}

std::string write_metadata(const Metadata& metadata) {
  Json attributes = Json::array();
  attributes.push_back(json_of(Attribute{"position", ScalarType::i32, 3}, metadata.ranges.at(0)));
  for (std::size_t i = 0; i < metadata.schema.size(); ++i)
    attributes.push_back(json_of(metadata.schema[i], metadata.ranges.at(i + 1)));
  const Json document{
      {"version", "2.0"},
      {"name", metadata.name},
      {"description", metadata.description},
      {"points", metadata.points},
      {"projection", metadata.projection},
      {"hierarchy",
       {{"firstChunkSize", metadata.first_piece_bytes}, {"stepSize", metadata.step_size}, {"depth", metadata.depth}}},
      {"offset", json_of(metadata.grid.offset)},
      {"scale", json_of(metadata.grid.scale)},
      {"spacing", metadata.spacing},
      {"boundingBox", {{"min", json_of(metadata.cube.min)}, {"max", json_of(metadata.cube.max)}}},
      {"encoding", metadata.encoding == Encoding::brotli ? "BROTLI" : "DEFAULT"},
      {"attributes", attributes}};
  return document.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace stipple::potree2
