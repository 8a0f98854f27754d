// What points take to draw.
#pragma once

namespace stipple {

// A frame costs a fixed part (reproject, clear) and a part per point. A Kalman filter follows both: the load of the
// machine scales them together and changes from frame to frame, how they share a frame's time changes slowly.
// docs/decisions/0017-frame-time.md has what was measured. Pure: time comes in as an argument.
class FrameCost {
 public:
  bool known() const { return per_point_ms_ > 0.0; }
  // Milliseconds; 0 while nothing is known, as those below.
  double of(double points) const { return fixed_ms_ + per_point_ms_ * points; }
  double fixed() const { return fixed_ms_; }
  double per_point() const { return per_point_ms_; }
  // Points that this time is enough for; below 0 where it is less than the fixed part. Something must be known.
  double points_in(double milliseconds) const { return (milliseconds - fixed_ms_) / per_point_ms_; }

  // What a frame with so many points took, both above 0. The fewer of its budget they are, the less is learnt from it.
  void learn(double points, double budget, double milliseconds);
  // A frame had none of these, perhaps because the fixed part alone seems to cost too much: believes that a little
  // less.
  void doubt_fixed_part();
  // Frames have so many times the pixels from now on, which is what the fixed part goes by.
  void scale_fixed_part(double ratio);

 private:
  void begin(double points, double milliseconds);
  void correct(double points, double budget, double milliseconds);

  double fixed_ms_ = 0.0;
  double per_point_ms_ = 0.0;
  // Their covariance
  double fixed2_ = 0.0;
  double fixed_per_point_ = 0.0;
  double per_point2_ = 0.0;
  int surprise_ = 0;  // 1, -1: the last frame took far more, far less than expected
};

}  // namespace stipple
