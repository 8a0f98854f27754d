#include "octree/store/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "octree/read/input_file.h"

namespace stipple {
namespace {

using Json = nlohmann::ordered_json;

// "12.5", "\"abc\"", "a list": short, whatever it is.
std::string describe(const Json& json) {
  constexpr std::size_t kLongest = 40;
  if (json.is_object()) return "an object";
  if (json.is_array()) return fmt::format("a list of {}", json.size());
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

}  // namespace

JsonValue JsonValue::operator[](std::string_view key) const {
  if (const auto value = find(key)) return *value;
  throw error(fmt::format("there is no \"{}\", which was expected.", key));
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (!json_->is_object()) throw expected("an object");
  const auto found = json_->find(key);
  if (found == json_->end()) return std::nullopt;
  return JsonValue(*found, *path_, key_.empty() ? std::string(key) : fmt::format("{}.{}", key_, key));
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!json_->is_array()) throw expected("a list");
  std::vector<JsonValue> elements;
  for (std::size_t i = 0; i < json_->size(); ++i)
    elements.push_back(JsonValue((*json_)[i], *path_, fmt::format("{}[{}]", key_, i)));
  return elements;
}

std::vector<JsonValue> JsonValue::elements(std::size_t count) const {
  if (!json_->is_array() || json_->size() != count) throw expected(fmt::format("a list of {}", count));
  return elements();
}

const std::string& JsonValue::text() const {
  if (!json_->is_string()) throw expected("a text");
  return json_->get_ref<const std::string&>();
}

double JsonValue::number() const {
  if (!json_->is_number() || !std::isfinite(json_->get<double>())) throw expected("a number");
  return json_->get<double>();
}

double JsonValue::number_or_nan() const {
  return json_->is_null() ? std::numeric_limits<double>::quiet_NaN() : number();
}

std::uint64_t JsonValue::whole(std::uint64_t lowest, std::uint64_t highest) const {
  const auto wrong = [&] { return expected(fmt::format("a whole number from {} to {}", lowest, highest)); };
  std::uint64_t value = 0;
  if (json_->is_number_unsigned()) {
    value = json_->get<std::uint64_t>();
  } else {
    // Some write 1e6 or 1000000.0
    constexpr double kAllWholeBelow = 9007199254740992.0;
    const double real = json_->is_number() ? json_->get<double>() : -1.0;
    if (!(real >= 0.0 && real < kAllWholeBelow && real == std::floor(real))) throw wrong();
    value = static_cast<std::uint64_t>(real);
  }
  if (value < lowest || value > highest) throw wrong();
  return value;
}

glm::dvec3 JsonValue::vector() const {
  const std::vector<JsonValue> values = elements(3);
  return {values[0].number(), values[1].number(), values[2].number()};
}

ScalarType JsonValue::scalar_type() const {
  for (int i = 0; i <= static_cast<int>(ScalarType::f64); ++i)
    if (name_of(static_cast<ScalarType>(i)) == text()) return static_cast<ScalarType>(i);
  throw error(fmt::format("\"{}\" is no type that Potree has.", text()));
}

Error JsonValue::error(std::string_view what) const {
  if (key_.empty()) return Error(fmt::format("{}: {}", *path_, what));
  return Error(fmt::format("{}: {}: {}", *path_, key_, what));
}

Error JsonValue::expected(std::string_view what) const {
  return error(fmt::format("{} was found, and {} was expected.", describe(*json_), what));
}

std::string read_json_file(const std::string& path) {
  constexpr std::uint64_t kMost = std::uint64_t{64} << 20;
  const InputFile file(path);
  if (file.size() > kMost)
    throw file_error(path, kMost, "the file goes on here, and JSON that describes an octree is never as long.");
  std::string text(static_cast<std::size_t>(file.size()), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(text)));
  return text;
}

Json parse_json(std::string_view text, std::string_view path) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    // The library counts bytes from 1
    throw file_error(path, error.byte - std::min<std::size_t>(error.byte, 1),
                     "this is no JSON any more. The file was cut off or damaged; copy it again.");
  } catch (const Json::exception&) {
    throw file_error(path, 0,
                     "a number in this JSON is too large for any computer. The file is damaged; copy it again.");
  }
}

}  // namespace stipple
