#include "src/command/build_inputs.h"

#include <fmt/format.h>

#include "octree/open/open.h"
#include "src/cli/cli.h"

namespace stipple {

std::vector<std::unique_ptr<PointSource>> open_inputs(const std::vector<std::string>& paths) {
  auto sources = open_each(paths);
  for (const auto& source : sources)
    for (const std::string& warning : source->info().warnings)
      warn(fmt::format("{}: {}", source->info().path, warning));
  return sources;
}

}  // namespace stipple
