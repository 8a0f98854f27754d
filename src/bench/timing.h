// Repeated timing of one piece of work.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/json/json.h"

namespace stipple {

// What `repeats` runs of one part took, after one run that does not count.
struct Timing {
  std::string part;
  std::string unit;     // of `amount`: "points", "frames"
  double amount = 0.0;  // worked off in one run
  std::vector<double> milliseconds;
  Json details = Json::object();  // of the last run: more keys for json()
  std::string remark;             // the same in words, for readers

  double median_ms() const;
  double per_second() const { return amount / (1e-3 * median_ms()); }
  Json json() const;
};

// `before`, where there is one, goes before every run and is not timed.
Timing time_part(std::string part, double amount, std::string unit, int repeats, const std::function<void()>& work,
                 const std::function<void()>& before = {});

}  // namespace stipple
