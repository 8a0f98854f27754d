// FrameCost and BudgetController (render/frame) where the GPU steers: the same members, the same steps; what they are for
// is said there.
struct Budget {
  double target_ms;
  double fixed_ms;
  double per_point_ms;  // ms a point; 0: no frame yet
  // Their covariance
  double fixed2;
  double fixed_per_point;
  double per_point2;
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
const double kLeastPerPoint = 0.5lf;
const double kLargestStep = 4.0lf;

void begin_budget(inout Budget b, double points, double milliseconds) {
  b.fixed_ms = kFirstFixed * milliseconds;
  b.per_point_ms = (milliseconds - b.fixed_ms) / points;
  b.fixed2 = b.fixed_ms * b.fixed_ms;
  b.fixed_per_point = -b.fixed2 / points;
  b.per_point2 = b.fixed2 / (points * points);
}

void scale_both(inout Budget b, double variance) {
  b.fixed2 += variance * b.fixed_ms * b.fixed_ms;
  b.fixed_per_point += variance * b.fixed_ms * b.per_point_ms;
  b.per_point2 += variance * b.per_point_ms * b.per_point_ms;
}

void correct_budget(inout Budget b, double points, double milliseconds) {
  double expected = b.fixed_ms + b.per_point_ms * points;
  scale_both(b, kLoad * kLoad);
  b.fixed2 += kSplit * kSplit * expected * expected;
  b.per_point2 += kSplit * kSplit * b.per_point_ms * b.per_point_ms;

  double noise = kNoise * expected * max(1.0lf, double(b.points_next) / points);
  double known = b.fixed2 + 2.0lf * points * b.fixed_per_point + points * points * b.per_point2;
  double bound = kSurprise * sqrt(known + noise * noise);
  double error = milliseconds - expected;
  int surprise = error > bound ? 1 : error < -bound ? -1 : 0;
  if (surprise != 0 && surprise == b.surprise)
    scale_both(b, error * error / (expected * expected));
  else
    error = clamp(error, -bound, bound);
  b.surprise = surprise;

  double with_fixed = b.fixed2 + points * b.fixed_per_point;
  double with_per_point = b.fixed_per_point + points * b.per_point2;
  double variance = with_fixed + points * with_per_point + noise * noise;
  double fixed_ms = b.fixed_ms + with_fixed / variance * error;
  double corrected = fixed_ms + (b.per_point_ms + with_per_point / variance * error) * points;
  b.fixed2 -= with_fixed * with_fixed / variance;
  b.fixed_per_point -= with_fixed * with_per_point / variance;
  b.per_point2 -= with_per_point * with_per_point / variance;

  b.fixed_ms = clamp(fixed_ms, 0.0lf, max(0.0lf, corrected - kLeastPerPoint * b.per_point_ms * points));
  b.per_point_ms = (corrected - b.fixed_ms) / points;
}

void frame_done(inout Budget b, double points, double milliseconds) {
  if (points == 0.0lf || milliseconds <= 0.0lf) return;
  if (b.per_point_ms == 0.0lf)
    begin_budget(b, points, milliseconds);
  else
    correct_budget(b, points, milliseconds);
  double now = double(b.points_next);
  double next = clamp((b.target_ms - b.fixed_ms) / b.per_point_ms, now / kLargestStep, now * kLargestStep);
  b.points_next = uint(clamp(next, double(b.least), double(b.most)));
}
