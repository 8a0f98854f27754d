// Frames of a curve kept as pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/measure/image.h"
#include "src/study/curve.h"

namespace stipple {

// The first frame, the last, and in between each time the points drawn have doubled, or every so many frames.
class FrameKeeper {
 public:
  // Below the study's folder `root`; what an earlier study left in `folder` is gone. `every`: frames from one kept to
  // the next; 0: by the points drawn.
  FrameKeeper(const std::filesystem::path& root, std::filesystem::path folder, std::string provenance,
              std::uint64_t every);

  void offer(const FrameState& state, const Image& image);
  // Whatever was kept before.
  void keep(const FrameState& state, const Image& image);
  const std::vector<KeptFrame>& kept() const { return kept_; }

 private:
  std::filesystem::path root_;
  std::filesystem::path folder_;  // below root_
  std::string provenance_;
  std::uint64_t every_;
  std::uint64_t next_ = 0;
  std::vector<KeptFrame> kept_;
};

}  // namespace stipple
