#include "octree/read/text/number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace stipple {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Powers that are exact doubles. A quotient or product of two exact doubles is correctly rounded: Clinger 1990, "How to
// read floating point numbers accurately".
constexpr std::array<double, 23> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                         1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53;
constexpr int kSafeDigits = 19;         // fit into 64 bits
constexpr int kLargestExponent = 9999;  // beyond, the number is 0 or infinite whatever its digits

bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}

// The digits of a number in pieces.
struct Decimal {
  std::uint64_t mantissa = 0;  // wrapped around when there are more than kSafeDigits
  int digits = 0;
  int exponent = 0;
};

const char* read_digits(const char* at, const char* end, Decimal& decimal) {
  const char* p = at;
  for (; p != end && is_digit(*p); ++p) decimal.mantissa = decimal.mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
  decimal.digits += static_cast<int>(std::min<std::ptrdiff_t>(p - at, 1'000'000));
  return p;
}

// "e-5"; leaves `at` where it is when no exponent follows.
const char* read_exponent(const char* at, const char* end, int& exponent) {
  if (at == end || (*at | 0x20) != 'e') return at;
  const char* p = at + 1;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  if (p == end || !is_digit(*p)) return at;
  int value = 0;
  for (; p != end && is_digit(*p); ++p)
    if (value < kLargestExponent) value = value * 10 + (*p - '0');
  exponent += negative ? -value : value;
  return p;
}

// "nan", "inf", "infinity", "nan(...)"; and "1.#QNAN" from its "#" on.
const char* read_word(const char* at, const char* end, double& value) {
  static constexpr std::pair<std::string_view, double> kWords[] = {
      {"infinity", kInfinity}, {"inf", kInfinity}, {"nan(ind)", kNan}, {"nan(snan)", kNan}, {"nan", kNan},
      {"#qnan", kNan},         {"#snan", kNan},    {"#ind", kNan},     {"#inf", kInfinity}};
  for (const auto& [word, meaning] : kWords) {
    if (static_cast<std::size_t>(end - at) < word.size()) continue;
    bool same = true;
    for (std::size_t i = 0; i < word.size() && same; ++i)
      same = (at[i] >= 'A' && at[i] <= 'Z' ? at[i] | 0x20 : at[i]) == word[i];
    if (!same) continue;
    value = meaning;
    const char* p = at + word.size();
    while (word.front() == '#' && p != end && is_digit(*p)) ++p;  // "1.#INF00"
    return p;
  }
  return nullptr;
}

// For the few that have too many digits or too large an exponent for exact doubles.
double slow_value(const char* at, const char* end, int exponent) {
  double value = 0.0;
  if (std::from_chars(at, end, value).ec == std::errc::result_out_of_range) return exponent > 0 ? kInfinity : 0.0;
  return value;
}

template <class T>
bool store(double value, std::byte* out) {
  double low = static_cast<double>(std::numeric_limits<T>::min());
  double high = static_cast<double>(std::numeric_limits<T>::max());
  if constexpr (sizeof(T) <= 2) {
    low = static_cast<double>(std::numeric_limits<std::make_signed_t<T>>::min());
    high = static_cast<double>(std::numeric_limits<std::make_unsigned_t<T>>::max());
  }
  if (!(value >= low && value <= high) || value != std::trunc(value)) return false;
  const auto stored = static_cast<T>(static_cast<std::int64_t>(value));
  std::memcpy(out, &stored, sizeof stored);
  return true;
}

// More digits than a double has.
template <class T>
const char* parse_long(const char* at, const char* end, std::byte* out) {
  T value{};
  const auto [after, error] = std::from_chars(at != end && *at == '+' ? at + 1 : at, end, value);
  if (error == std::errc() && (after == end || (*after != '.' && (*after | 0x20) != 'e'))) {
    std::memcpy(out, &value, sizeof value);
    return after;
  }
  double real = 0.0;
  const char* const p = parse_number(at, end, real);
  if (!p || real != std::trunc(real) || !(std::abs(real) < static_cast<double>(kExactMantissa)) ||
      (real < 0.0 && !std::numeric_limits<T>::is_signed))
    return nullptr;
  value = static_cast<T>(real);
  std::memcpy(out, &value, sizeof value);
  return p;
}

bool store(ScalarType type, double value, std::byte* out) {
  switch (type) {
    case ScalarType::u8:
      return store<std::uint8_t>(value, out);
    case ScalarType::i8:
      return store<std::int8_t>(value, out);
    case ScalarType::u16:
      return store<std::uint16_t>(value, out);
    case ScalarType::i16:
      return store<std::int16_t>(value, out);
    case ScalarType::u32:
      return store<std::uint32_t>(value, out);
    case ScalarType::i32:
      return store<std::int32_t>(value, out);
    case ScalarType::f32: {
      // Beyond the largest float, a conversion is undefined; this is what rounding gives
      const auto single = std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())
                              ? static_cast<float>(std::copysign(kInfinity, value))
                              : static_cast<float>(value);
      std::memcpy(out, &single, sizeof single);
      return true;
    }
    default:
      std::memcpy(out, &value, sizeof value);
      return true;
  }
}

}  // namespace

const char* parse_number(const char* at, const char* end, double& value) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  Decimal decimal;
  const char* p = read_digits(at, end, decimal);
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    p = read_digits(fraction, end, decimal);
    decimal.exponent = -static_cast<int>(std::min<std::ptrdiff_t>(p - fraction, 1'000'000));
  }
  if (decimal.digits == 0 || (p != end && *p == '#')) {
    p = read_word(p, end, value);
    if (p && negative) value = -value;
    return p;
  }
  const int written = decimal.exponent;
  p = read_exponent(p, end, decimal.exponent);
  if (decimal.digits <= kSafeDigits && decimal.mantissa <= kExactMantissa && decimal.exponent >= -22 &&
      decimal.exponent <= 22) {
    const double mantissa = static_cast<double>(decimal.mantissa);
    value = decimal.exponent < 0 ? mantissa / kPowers[static_cast<std::size_t>(-decimal.exponent)]
                                 : mantissa * kPowers[static_cast<std::size_t>(decimal.exponent)];
  } else {
    value = slow_value(at, p, decimal.exponent - written);
  }
  if (negative) value = -value;
  return p;
}

const char* parse_as(ScalarType type, const char* at, const char* end, std::byte* out) {
  if (type == ScalarType::i64) return parse_long<std::int64_t>(at, end, out);
  if (type == ScalarType::u64) return parse_long<std::uint64_t>(at, end, out);
  double value = 0.0;
  const char* const after = parse_number(at, end, value);
  return after && store(type, value, out) ? after : nullptr;
}

}  // namespace stipple
