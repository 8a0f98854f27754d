#include "octree/read/table/position_scan.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stipple {
namespace {

constexpr int kNone = -1;
constexpr int kMaxBinary = 200;      // steps of 2^-200: finer ones are noise around zero
constexpr int kMaxDecimal = 18;      // 10^18 is a double, and so is every smaller power
constexpr double kRound = 0x1.8p52;  // added and taken away, it rounds what is below 2^51 to whole numbers
constexpr double kExact = 0x1p51;
constexpr double kTelling = 0x1p49;    // from here on, doubles are too coarse to tell decimal numbers from others
constexpr double kCoarsest = 0x1p-12;  // of the longest edge
constexpr double kSlack = 4.0;         // of kGridSteps, for ranges that are still growing

constexpr std::array<double, kMaxDecimal + 1> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                           1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

bool on_binary(double value, double steps) {
  const double at = value * steps;
  return std::abs(at) >= kExact || (at + kRound) - kRound == at;
}

template <bool kSingle>
bool on_decimal(double value, double steps) {
  const double whole = (value * steps + kRound) - kRound;
  const double back = whole / steps;
  if (!(std::abs(whole) < kTelling)) return false;
  if constexpr (kSingle) return static_cast<float>(back) == static_cast<float>(value);
  return back == value;
}

// Raises `digits` until all values are on the grid, or makes it kNone where that takes more steps than 32 bits have.
template <class Steps, class OnGrid>
void raise(int& digits, int most, std::span<const double> values, double extent, const Steps& steps,
           const OnGrid& on_grid) {
  if (digits == kNone) return;
  double at = steps(digits);
  for (const double value : values) {
    while (!on_grid(value, at)) {
      if (++digits > most || extent * steps(digits) > kGridSteps * kSlack) {
        digits = kNone;
        return;
      }
      at = steps(digits);
    }
  }
}

double power_of_two(int exponent) {
  return std::ldexp(1.0, exponent);
}

// 2^n, at most `value`; above zero.
double power_of_two_below(double value) {
  return power_of_two(std::max(std::ilogb(value), -kMaxBinary));
}

double extent_of(const AxisScan& axis) {
  return axis.empty() ? 0.0 : axis.range().max - axis.range().min;
}

struct AxisGrid {
  double offset = 0.0;
  double scale = 1.0;
};

// The offset is a whole number of steps, so that what is a multiple of the scale stays exact.
AxisGrid placed(const AxisScan& axis, double scale) {
  return {axis.empty() ? 0.0 : fitting_offset(0.0, scale, axis.range()), scale};
}

bool fits(const AxisScan& axis, double scale) {
  return extent_of(axis) / scale <= kGridSteps;
}

// The scale of `digits` digits, or of as many more as make it no coarser than it may be.
template <class Scale>
double fine_scale(int digits, int most, double coarsest, const Scale& scale) {
  while (scale(digits) > coarsest && digits < most) ++digits;
  return scale(digits);
}

// One scale for all axes from the digits that each needs, if there is one and all fit.
template <class Digits, class Scale>
std::optional<double> common_scale(const std::array<AxisScan, 3>& axes, double coarsest, int most, const Digits& digits,
                                   const Scale& scale) {
  int needed = 0;
  for (const AxisScan& axis : axes) {
    if (digits(axis) == kNone) return std::nullopt;
    needed = std::max(needed, digits(axis));
  }
  const double chosen = fine_scale(needed, most, coarsest, scale);
  for (const AxisScan& axis : axes)
    if (!fits(axis, chosen)) return std::nullopt;
  return chosen;
}

int trusted_decimal_digits(const AxisScan& axis) {
  const int digits = axis.decimal_digits();
  if (digits == kNone || axis.empty()) return digits;
  const double largest = std::max(std::abs(axis.range().min), std::abs(axis.range().max));
  return largest * kPowersOfTen[static_cast<std::size_t>(digits)] < kTelling ? digits : kNone;
}

double decimal_scale(int digits) {
  return 1.0 / kPowersOfTen[static_cast<std::size_t>(digits)];
}

double binary_scale(int digits) {
  return power_of_two(-digits);
}

// One axis by itself; `rounding` grows to what its grid costs.
AxisGrid own_grid(const AxisScan& axis, double coarsest, double& rounding) {
  if (const int digits = axis.binary_digits(); digits != kNone)
    if (const double scale = fine_scale(digits, kMaxBinary, coarsest, binary_scale); fits(axis, scale))
      return placed(axis, scale);
  if (const int digits = trusted_decimal_digits(axis); digits != kNone)
    if (const double scale = fine_scale(digits, kMaxDecimal, coarsest, decimal_scale); fits(axis, scale))
      return placed(axis, scale);
  double scale = power_of_two_below(extent_of(axis) / kGridSteps);
  if (!fits(axis, scale)) scale *= 2.0;
  rounding = std::max(rounding, scale * 0.5);
  return placed(axis, scale);
}

}  // namespace

void AxisScan::add(std::span<const double> values, bool single) {
  if (values.empty()) return;
  double low = values[0], high = values[0];
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  range_ = empty() ? AxisRange{low, high} : AxisRange{std::min(range_.min, low), std::max(range_.max, high)};
  const double extent = range_.max - range_.min;
  raise(binary_, kMaxBinary, values, extent, power_of_two, on_binary);
  const auto tens = [](int digits) { return kPowersOfTen[static_cast<std::size_t>(digits)]; };
  if (single)
    raise(decimal_, kMaxDecimal, values, extent, tens, on_decimal<true>);
  else
    raise(decimal_, kMaxDecimal, values, extent, tens, on_decimal<false>);
}

void AxisScan::merge(const AxisScan& other) {
  if (other.empty()) return;
  range_ = empty() ? other.range_
                   : AxisRange{std::min(range_.min, other.range_.min), std::max(range_.max, other.range_.max)};
  const auto most = [](int a, int b) { return a == kNone || b == kNone ? kNone : std::max(a, b); };
  binary_ = most(binary_, other.binary_);
  decimal_ = most(decimal_, other.decimal_);
}

ChosenGrid choose_grid(const std::array<AxisScan, 3>& axes) {
  double longest = 0.0;
  for (const AxisScan& axis : axes) longest = std::max(longest, extent_of(axis));
  const double coarsest = (longest > 0.0 ? longest : 1.0) * kCoarsest;

  std::optional<double> scale = common_scale(
      axes, coarsest, kMaxBinary, [](const AxisScan& axis) { return axis.binary_digits(); }, binary_scale);
  if (!scale) scale = common_scale(axes, coarsest, kMaxDecimal, trusted_decimal_digits, decimal_scale);
  ChosenGrid chosen;
  for (int a = 0; a < 3; ++a) {
    const AxisScan& axis = axes[static_cast<std::size_t>(a)];
    const AxisGrid grid = scale ? placed(axis, *scale) : own_grid(axis, coarsest, chosen.largest_rounding);
    chosen.grid.offset[a] = grid.offset;
    chosen.grid.scale[a] = grid.scale;
  }
  return chosen;
}

}  // namespace stipple
