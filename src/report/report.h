// A study as a page that one can read and publish from.
#pragma once

#include <span>
#include <string>

#include "src/json/json.h"
#include "src/study/curve.h"

namespace stipple {

// An HTML document that needs nothing beside itself. `document` is what study.json holds, `curves` what curves.csv
// does; the pictures are read from where the study has left them, below `folder`. About 20 MB at most. Throws Error
// when a picture cannot be read.
std::string report_html(const Json& document, std::span<const Curve> curves, const std::string& folder);

}  // namespace stipple
