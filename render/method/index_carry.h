// The carry of S18: Schuetz, Wimmer 2018, "Progressive Real-Time Rendering of Unprocessed Point Clouds", section 3.
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// Where S19 copies whole vertices, S18 keeps their places in the cloud's buffers, which are drawn indirectly.
class IndexCarry {
 public:
  // `slot_of[id]`: where the cloud, which must outlive this, has the point. Throws Error when there are more than this
  // driver's shaders reach.
  IndexCarry(const GpuCloud& cloud, std::span<const std::uint32_t> slot_of);
  // The same in a buffer, which may change between frames and must outlive this, too.
  IndexCarry(const GpuCloud& cloud, const GpuBuffer& slot_of);
  IndexCarry(const IndexCarry&) = delete;
  IndexCarry& operator=(const IndexCarry&) = delete;

  // The items that draw what this finished frame shows, one a chunk. Valid until the next call.
  void append_items(const FeedbackTarget& frame, std::vector<DrawItem>& items);

 private:
  void prepare(const FeedbackTarget& frame);

  const GpuCloud& cloud_;
  GpuBuffer own_slots_;
  const GpuBuffer& slot_of_;
  GpuBuffer places_;
  GpuBuffer commands_;
  Program count_;
  Program begin_;
  Program write_;
};

}  // namespace stipple
