#include "src/study/regime.h"

#include <array>

namespace stipple {
namespace {

constexpr std::array kRegimes{Regime::cold, Regime::jump, Regime::path, Regime::stop};

}  // namespace

std::span<const Regime> all_regimes() {
  return kRegimes;
}

std::string_view name_of(Regime regime) {
  switch (regime) {
    case Regime::cold:
      return "cold";
    case Regime::jump:
      return "jump";
    case Regime::path:
      return "path";
    case Regime::stop:
      return "stop";
  }
  return "";
}

std::optional<Regime> regime_named(std::string_view name) {
  for (const Regime regime : kRegimes)
    if (name_of(regime) == name) return regime;
  return std::nullopt;
}

}  // namespace stipple
