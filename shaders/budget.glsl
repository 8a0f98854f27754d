// BudgetController (render/frame/budget.cpp) where the GPU steers: the same members, the same steps; what they are for
// is said there.
struct Budget {
  double target_ms;
  double fixed_ms;
  double slope;  // ms a point; 0: no frame yet
  // Their covariance
  double fixed2;
  double fixed_slope;
  double slope2;
  uint least;
  uint most;
  uint points_next;
  int surprise;
};

const double kLoad = 0.07lf;
const double kSplit = 0.02lf;
const double kNoise = 0.05lf;
const double kSurprise = 2.0lf;
const double kFirstFixed = 0.25lf;
const double kLeastSlope = 0.5lf;
const double kLargestStep = 4.0lf;

void begin_budget(inout Budget b, double points, double milliseconds) {
  b.fixed_ms = kFirstFixed * milliseconds;
  b.slope = (milliseconds - b.fixed_ms) / points;
  b.fixed2 = b.fixed_ms * b.fixed_ms;
  b.fixed_slope = -b.fixed2 / points;
  b.slope2 = b.fixed2 / (points * points);
}

void scale_both(inout Budget b, double variance) {
  b.fixed2 += variance * b.fixed_ms * b.fixed_ms;
  b.fixed_slope += variance * b.fixed_ms * b.slope;
  b.slope2 += variance * b.slope * b.slope;
}

void correct_budget(inout Budget b, double points, double milliseconds) {
  double expected = b.fixed_ms + b.slope * points;
  scale_both(b, kLoad * kLoad);
  b.fixed2 += kSplit * kSplit * expected * expected;
  b.slope2 += kSplit * kSplit * b.slope * b.slope;

  double noise = kNoise * expected * max(1.0lf, double(b.points_next) / points);
  double known = b.fixed2 + 2.0lf * points * b.fixed_slope + points * points * b.slope2;
  double bound = kSurprise * sqrt(known + noise * noise);
  double error = milliseconds - expected;
  int surprise = error > bound ? 1 : error < -bound ? -1 : 0;
  if (surprise != 0 && surprise == b.surprise)
    scale_both(b, error * error / (expected * expected));
  else
    error = clamp(error, -bound, bound);
  b.surprise = surprise;

  double with_fixed = b.fixed2 + points * b.fixed_slope;
  double with_slope = b.fixed_slope + points * b.slope2;
  double variance = with_fixed + points * with_slope + noise * noise;
  double fixed_ms = b.fixed_ms + with_fixed / variance * error;
  double corrected = fixed_ms + (b.slope + with_slope / variance * error) * points;
  b.fixed2 -= with_fixed * with_fixed / variance;
  b.fixed_slope -= with_fixed * with_slope / variance;
  b.slope2 -= with_slope * with_slope / variance;

  b.fixed_ms = clamp(fixed_ms, 0.0lf, max(0.0lf, corrected - kLeastSlope * b.slope * points));
  b.slope = (corrected - b.fixed_ms) / points;
}

void frame_done(inout Budget b, double points, double milliseconds) {
  if (points == 0.0lf || milliseconds <= 0.0lf) return;
  if (b.slope == 0.0lf)
    begin_budget(b, points, milliseconds);
  else
    correct_budget(b, points, milliseconds);
  double now = double(b.points_next);
  double next = clamp((b.target_ms - b.fixed_ms) / b.slope, now / kLargestStep, now * kLargestStep);
  b.points_next = uint(clamp(next, double(b.least), double(b.most)));
}
