#include "src/bench/stopwatch.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "src/run/median.h"

namespace stipple {

double Timing::median_ms() const {
  return median(milliseconds);
}

Json Timing::json() const {
  return {{"part", part},
          {"median_ms", median_ms()},
          {"min_ms", std::ranges::min(milliseconds)},
          {"max_ms", std::ranges::max(milliseconds)},
          {"amount", amount},
          {"unit", unit},
          {"per_second", per_second()}};
}

Timing time_part(std::string part, double amount, std::string unit, int repeats, const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  Timing timing{std::move(part), std::move(unit), amount, {}};
  work();
  for (int i = 0; i < repeats; ++i) {
    const auto start = Clock::now();
    work();
    timing.milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  return timing;
}

}  // namespace stipple
