// A cloud on the GPU that is drawn while its points arrive.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/store/gpu_cloud.h"

namespace stipple {

// How points are shuffled as they arrive.
enum class ArrivalOrder {
  permuted,   // S19: to the slot that the shuffle of all points gives each; free slots repeat a point that is there
  displaced,  // S18: to a random slot among those taken, without a gap; what stood there goes to the end
};

class GrowingCloud {
 public:
  // Room for `total` points. `keep_slots`, of displaced ones: slot_of() is kept. Throws Error when memory is refused,
  // or when shaders cannot reach the slots of so many points.
  GrowingCloud(std::size_t total, ArrivalOrder order, std::uint64_t seed, bool keep_slots);

  // Adds points with ids first_id, first_id + 1, ..., all below `total`, each id once.
  void add(std::span<const PackedPoint> points, std::uint32_t first_id);

  const GpuCloud& cloud() const { return cloud_; }
  std::size_t points() const { return points_; }  // added
  // [0, slots()) may be drawn: every point added is there, and nothing else.
  std::size_t slots() const { return shuffler_ && points_ > 0 ? cloud_.size() : points_; }
  bool complete() const { return points_ == cloud_.size(); }
  // uint32 an id: its slot.
  const GpuBuffer& slot_of() const { return slot_of_; }
  // Sent to the GPU so far.
  std::uint64_t bytes_uploaded() const { return bytes_uploaded_; }

 private:
  void fill_with(const PackedPoint& point, std::uint32_t id);
  void insert(std::span<const PackedPoint> points, std::uint32_t first_id);
  void bind_chunks(std::size_t first) const;
  void move_chunk_by_chunk(const Program& program, std::uint32_t first_slot, std::uint32_t first,
                           std::uint32_t count) const;

  GpuCloud cloud_;
  std::size_t points_ = 0;
  std::uint64_t bytes_uploaded_ = 0;
  std::optional<Shuffler> shuffler_;  // permuted

  // displaced
  std::uint64_t random_;
  bool keep_slots_;
  std::size_t bound_ = 0;  // chunks at a time
  Program gather_;
  Program put_;
  GpuBuffer staged_points_;
  GpuBuffer staged_ids_;
  GpuBuffer slots_;
  GpuBuffer slot_of_;
};

}  // namespace stipple
