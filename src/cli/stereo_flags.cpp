#include "src/cli/stereo_flags.h"

#include <fmt/format.h>

#include "octree/core/error.h"
#include "src/cli/cli.h"

namespace stipple {

void add_stereo_flags(CLI::App& command, StereoFlags& flags) {
  CLI::Option* on = command.add_flag(
      "--stereo", flags.on,
      "Draw for two eyes, the left one's picture on the left: one selection, drawn in both (Tredinnick and others "
      "2016). They look in the same direction, from either side of where the camera is. Each picture has --size, so "
      "that both together are twice as wide; so are the arrays of --depth-out and --position-out.");
  command
      .add_option("--eyes-apart", flags.apart,
                  "How far apart the eyes are, in the cloud's own units, as in 0.065. Default: a thirtieth of the "
                  "distance from eye to target.")
      ->needs(on);
}

void check(const StereoFlags& flags, const glm::ivec2& size) {
  if (!flags.apart.empty()) parse_positive("--eyes-apart", flags.apart);
  if (flags.on && size.x > kLargestPictureSide / 2)
    throw UsageError(fmt::format("--stereo: two pictures {} pixels wide are wider than {} together; each may be {}",
                                 size.x, kLargestPictureSide, kLargestPictureSide / 2));
}

double eyes_apart_of(const StereoFlags& flags, const Camera& camera) {
  if (!flags.on) return 0.0;
  return flags.apart.empty() ? kUsualEyesApart * glm::distance(camera.eye, camera.target)
                             : parse_positive("--eyes-apart", flags.apart);
}

}  // namespace stipple
