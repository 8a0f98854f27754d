// A value of a JSON file together with where it stands, so that what is wrong with it can be said.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/core/error.h"

namespace stipple {

// Refers to a document that has to live longer. All functions throw Error naming the file, the key and what was
// expected there.
class JsonValue {
 public:
  // The whole document; `path` is the file's.
  JsonValue(const nlohmann::ordered_json& document, const std::string& path) : json_(&document), path_(&path) {}

  JsonValue operator[](std::string_view key) const;           // has to be there
  std::optional<JsonValue> find(std::string_view key) const;  // may be missing
  std::vector<JsonValue> elements() const;                    // of an array
  std::vector<JsonValue> elements(std::size_t count) const;   // of an array that has to have as many
  bool is_object() const { return json_->is_object(); }
  bool is_text() const { return json_->is_string(); }
  const std::string& text() const;  // UTF-8
  double number() const;            // finite
  double number_or_nan() const;     // NaN for null
  std::uint64_t whole(std::uint64_t lowest, std::uint64_t highest) const;
  glm::dvec3 vector() const;       // an array of three finite numbers
  ScalarType scalar_type() const;  // "uint8", "int8", ... "double", as Potree spells them

  // "PATH: KEY: WHAT"
  Error error(std::string_view what) const;

 private:
  JsonValue(const nlohmann::ordered_json& json, const std::string& path, std::string key)
      : json_(&json), path_(&path), key_(std::move(key)) {}
  Error expected(std::string_view what) const;

  const nlohmann::ordered_json* json_;
  const std::string* path_;
  std::string key_;  // "hierarchy.depth", "attributes[3].type"; empty for the document
};

// The content of a file of JSON. Throws Error when it is longer than 64 MiB: nothing that describes a tree is.
std::string read_json_file(const std::string& path);

// Parses `text`. Throws Error naming the byte where it stops being JSON.
nlohmann::ordered_json parse_json(std::string_view text, std::string_view path);

}  // namespace stipple
