#include "render/method/skips.h"

#include <array>

namespace stipple {

std::span<const NamedSkip> all_skips() {
  static constexpr std::array kAll{
      NamedSkip{"frustum", &Skips::frustum},       NamedSkip{"occlusion", &Skips::occlusion},
      NamedSkip{"density", &Skips::density},       NamedSkip{"yield", &Skips::yield},
      NamedSkip{"rounds", &Skips::rounds},         NamedSkip{"done", &Skips::done},
      NamedSkip{"still", &Skips::still},           NamedSkip{"converged", &Skips::converged},
      NamedSkip{"attributes", &Skips::attributes}, NamedSkip{"nodes", &Skips::nodes}};
  return kAll;
}

}  // namespace stipple
