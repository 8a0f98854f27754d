// Curves as JSON, every number to the last bit: how an interrupted study finds what it had finished.
#pragma once

#include "src/json/json.h"
#include "src/study/curve.h"

namespace stipple {

Json json_of(const Curve& curve);
// What json_of gave. Throws nlohmann's exceptions where something is missing or of another type.
Curve curve_from(const Json& json);

}  // namespace stipple
