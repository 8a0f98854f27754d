// What the camera does while a method draws.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/method/method.h"

namespace stipple {

enum class Regime {
  cold,     // a still view, from nothing (Tredinnick and others 2016, section 5)
  jump,     // a still view, after another has converged
  path,     // each frame from the next place on a path
  stop,     // a still view, after a path that ends there
  loading,  // a still view, while the points are read
};

std::span<const Regime> all_regimes();
// "cold", "jump", "path", "stop", "loading".
std::string_view name_of(Regime regime);
std::optional<Regime> regime_named(std::string_view name);
// Whether it is about views; the others are about paths.
inline bool of_views(Regime regime) {
  return regime == Regime::cold || regime == Regime::jump || regime == Regime::loading;
}
// Those that can, in their order: while loading not every mode draws.
std::vector<Mode> modes_under(Regime regime, std::span<const Mode> modes);

}  // namespace stipple
