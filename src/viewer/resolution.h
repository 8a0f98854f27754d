// How coarse a moving picture has to be.
#pragma once

namespace stipple {

// A frame has a cost by its pixels that no budget of points lowers: carrying the last frame over. Where that takes most
// of the time a frame has, pictures have fewer pixels while the camera moves. Pure: times come in as arguments.
class Resolution {
 public:
  static constexpr int kCoarsest = 4;

  // Pixels of the window a pixel of the frame is wide and high.
  int divisor() const { return divisor_; }

  // What its pixels took of a frame of a moving camera, and what it may take in all, in milliseconds.
  void frame_done(double pixels_ms, double target_ms);

 private:
  int divisor_ = 1;
  int slow_ = 0;  // frames in a row
  int fast_ = 0;
};

}  // namespace stipple
