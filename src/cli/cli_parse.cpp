#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "octree/core/error.h"
#include "src/cli/cli.h"

namespace stipple {
namespace {

constexpr std::uint64_t kMaxCount = 1'000'000'000'000'000;  // whole numbers up to here are exact as doubles

UsageError bad_value(std::string_view option, std::string_view text, std::string_view expected) {
  return UsageError(fmt::format("{}: \"{}\" is not {}", option, text, expected));
}

// The whole text as a T, independent of the locale.
template <class T, class... Format>
std::optional<T> number(std::string_view text, Format... format) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, format...);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::optional<double> finite(std::string_view text) {
  const auto value = number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double factor_of(char suffix) {
  switch (suffix) {
    case 'k':
    case 'K':
      return 1e3;
    case 'm':
    case 'M':
      return 1e6;
    case 'g':
    case 'G':
      return 1e9;
    default:
      return 1.0;
  }
}

}  // namespace

glm::ivec2 parse_size(std::string_view option, std::string_view text) {
  const std::size_t x = text.find('x');
  if (x != std::string_view::npos) {
    const auto width = number<int>(text.substr(0, x));
    const auto height = number<int>(text.substr(x + 1));
    if (width && height && *width >= 1 && *width <= kLargestPictureSide && *height >= 1 &&
        *height <= kLargestPictureSide)
      return {*width, *height};
  }
  throw bad_value(option, text,
                  fmt::format("WIDTHxHEIGHT in pixels, 1 to {} each, such as 1280x720", kLargestPictureSide));
}

glm::dvec3 parse_vector(std::string_view option, std::string_view text) {
  glm::dvec3 out;
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? rest.find(',') : rest.size();
    const auto value = end == std::string_view::npos ? std::nullopt : finite(rest.substr(0, end));
    if (!value) throw bad_value(option, text, "three numbers x,y,z without spaces, such as 637000.5,851200,430");
    out[axis] = *value;
    if (axis < 2) rest.remove_prefix(end + 1);
  }
  return out;
}

std::uint32_t parse_color(std::string_view option, std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('#') ? 1 : 0);
  const auto value = number<std::uint32_t>(digits, 16);
  if (!value || digits.size() != 6)
    throw bad_value(option, text, "a colour of six hexadecimal digits RRGGBB, such as 808080");
  return *value;
}

double parse_positive(std::string_view option, std::string_view text) {
  const auto value = finite(text);
  if (!value || *value <= 0.0) throw bad_value(option, text, "a number above 0, such as 1.5");
  return *value;
}

std::uint64_t parse_count(std::string_view option, std::string_view text) {
  const double factor = text.empty() ? 1.0 : factor_of(text.back());
  const auto value = finite(text.substr(0, text.size() - (factor > 1.0 ? 1 : 0)));
  // 1.1 * 1e6 is not whole in binary: round, and allow for the rounding of the product
  const double count = value ? std::round(*value * factor) : 0.0;
  const bool whole = value && std::abs(*value * factor - count) <= 1e-15 * count;
  if (!whole || count < 1.0 || count > static_cast<double>(kMaxCount))
    throw bad_value(
        option, text,
        "a whole number above 0, plain or with k, M or G for thousands, millions or billions, such as 1.5M");
  return static_cast<std::uint64_t>(count);
}

std::uint64_t parse_bytes(std::string_view option, std::string_view text, std::uint64_t least) {
  static constexpr std::string_view kSuffixes = "kMG";
  std::size_t power = 0;
  if (!text.empty()) {
    const std::size_t suffix = kSuffixes.find(text.back() == 'K' ? 'k' : text.back());
    if (suffix != std::string_view::npos) power = suffix + 1;
  }
  constexpr double kMost = 1e18;
  const auto value = finite(text.substr(0, text.size() - (power > 0 ? 1 : 0)));
  const double bytes = value ? *value * static_cast<double>(std::uint64_t{1} << 10 * power) : 0.0;
  if (!(bytes >= static_cast<double>(least) && bytes <= kMost))
    throw bad_value(option, text,
                    fmt::format("an amount of memory of {}k or more, with k, M or G for powers of 1024 bytes, such as "
                                "512M",
                                least >> 10));
  return static_cast<std::uint64_t>(bytes);
}

std::string with_thousands(std::uint64_t value) {
  std::string text = fmt::format("{}", value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

}  // namespace stipple
