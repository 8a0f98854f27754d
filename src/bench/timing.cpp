#include "src/bench/timing.h"

#include <algorithm>
#include <utility>

#include "octree/core/stopwatch.h"
#include "src/run/median.h"

namespace stipple {

double Timing::median_ms() const {
  return median(milliseconds);
}

Json Timing::json() const {
  Json document{{"part", part},
                {"median_ms", median_ms()},
                {"min_ms", std::ranges::min(milliseconds)},
                {"max_ms", std::ranges::max(milliseconds)},
                {"amount", amount},
                {"unit", unit},
                {"per_second", per_second()},
                {"runs_ms", milliseconds}};
  document.update(details);
  return document;
}

Timing time_part(std::string part, double amount, std::string unit, int repeats, const std::function<void()>& work,
                 const std::function<void()>& before) {
  Timing timing{std::move(part), std::move(unit), amount, {}, Json::object(), ""};
  for (int i = 0; i <= repeats; ++i) {
    if (before) before();
    const Stopwatch watch;
    work();
    const double milliseconds = watch.milliseconds();
    if (i > 0) timing.milliseconds.push_back(milliseconds);
  }
  return timing;
}

}  // namespace stipple
