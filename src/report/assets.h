// The files that a report is made of; the build puts them in.
#pragma once

#include <string_view>

namespace stipple {

// Of src/report/page, or chart.min.js, the charting library; nothing for other names.
std::string_view report_asset(std::string_view name);

}  // namespace stipple
