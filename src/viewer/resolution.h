// How coarse a moving picture has to be.
#pragma once

namespace stipple {

// A frame has a cost by its pixels that no budget of points lowers: carrying the last frame over. Where that alone
// takes longer than a frame may, pictures have fewer pixels while the camera moves. Pure: times come in as arguments.
class Resolution {
 public:
  static constexpr int kCoarsest = 4;

  // Pixels of the window a pixel of the frame is wide and high.
  int divisor() const { return divisor_; }

  // What a frame of a moving camera took, in milliseconds, and whether it had as few points as it may have.
  void frame_done(double ms, bool least_points, double target_ms);

 private:
  int divisor_ = 1;
  int slow_ = 0;  // frames in a row
  int fast_ = 0;
};

}  // namespace stipple
