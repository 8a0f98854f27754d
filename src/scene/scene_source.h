// A generated scene as a source of points.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "octree/cloud/source.h"
#include "src/scene/model.h"

namespace stipple::scene {

// Points are made when they are read, 65,536 at a time, and never kept: a scene of any size needs only the memory of
// its model. They carry "rgb" (8-bit colours times 257), "intensity" and "classification".
class SceneSource : public PointSource {
 public:
  SceneSource(const std::string& name, std::uint64_t points, std::unique_ptr<const SceneModel> model);

  const SourceInfo& info() const override { return info_; }
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  SourceInfo info_;
  std::unique_ptr<const SceneModel> model_;
};

}  // namespace stipple::scene
