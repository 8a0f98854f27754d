#include "src/study/regime.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "render/method/while_loading.h"

namespace stipple {
namespace {

constexpr std::array kRegimes{Regime::cold, Regime::jump, Regime::path, Regime::stop, Regime::loading};

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
    case Regime::loading:
      return "loading";
  }
  return "";
}

std::optional<Regime> regime_named(std::string_view name) {
  for (const Regime regime : kRegimes)
    if (name_of(regime) == name) return regime;
  return std::nullopt;
}

std::vector<Mode> modes_under(Regime regime, std::span<const Mode> modes) {
  std::vector<Mode> able;
  std::ranges::copy_if(modes, std::back_inserter(able),
                       [regime](Mode mode) { return regime != Regime::loading || draws_while_loading(mode); });
  return able;
}

}  // namespace stipple
