// What a frame leaves for the next one.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "render/frame/frame_data.h"
#include "render/frame/view_block.h"
#include "render/gpu/texture.h"

namespace stipple {

// How a rasterizer keeps depth: in a depth attachment or in an image that compute shaders reach with atomics. Both
// hold near / distance as 32-bit float, 0 where nothing is.
enum class DepthStorage { attachment, image };

// Per pixel: the point (grid position and packed attribute, RGBA32I), its id (R32UI, kNoPoint where none) and depth.
class FeedbackTarget {
 public:
  FeedbackTarget(const glm::ivec2& size, DepthStorage storage);

  const glm::ivec2& size() const { return ids_.size(); }
  const Texture2D& points() const { return points_; }
  const Texture2D& ids() const { return ids_; }
  const Texture2D& depth() const { return depth_; }
  // Like ids(), but of a point that covers several pixels only one keeps its id, so that the next frame draws it once
  // (CarryOnce). Where points cover no more than a pixel: ids().
  const Texture2D& carried_ids() const { return carried_ids_ ? *carried_ids_ : ids_; }
  // Where these go, empty at first.
  const Texture2D& make_carried_ids();
  DepthStorage depth_storage() const { return storage_; }

  // No point anywhere.
  void clear();
  // Copies the frame to main memory. `near` as in the view it was drawn with.
  FrameData read(double near) const;

 private:
  DepthStorage storage_;
  Texture2D points_;
  Texture2D ids_;
  Texture2D depth_;
  std::optional<Texture2D> carried_ids_;
};

}  // namespace stipple
