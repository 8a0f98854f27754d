// BudgetController (render/frame/budget.cpp) where the GPU steers: the same members, the same steps.
struct Budget {
  double target_ms;
  // Weighted sums over past frames of 1, points, ms, points^2, points * ms
  double weight;
  double points;
  double ms;
  double points2;
  double points_ms;
  uint least;
  uint most;
  uint points_next;
};

const double kMemory = 0.7lf;
const double kTellingVariance = 0.05lf;
const double kLargestStep = 2.0lf;

void frame_done(inout Budget b, double points, double milliseconds) {
  b.weight = kMemory * b.weight + 1.0lf;
  b.points = kMemory * b.points + points;
  b.ms = kMemory * b.ms + milliseconds;
  b.points2 = kMemory * b.points2 + points * points;
  b.points_ms = kMemory * b.points_ms + points * milliseconds;

  double mean_points = b.points / b.weight;
  double mean_ms = b.ms / b.weight;
  double variance = b.points2 / b.weight - mean_points * mean_points;
  double per_point = mean_points > 0.0lf ? mean_ms / mean_points : 0.0lf;
  if (variance > kTellingVariance * mean_points * mean_points) {
    double slope = (b.points_ms / b.weight - mean_points * mean_ms) / variance;
    per_point = clamp(slope, 0.25lf * per_point, per_point);
  }
  if (per_point <= 0.0lf) return;

  double wanted = mean_points + (b.target_ms - mean_ms) / per_point;
  double now = double(b.points_next);
  double next = clamp(wanted, now / kLargestStep, now * kLargestStep);
  b.points_next = uint(clamp(next, double(b.least), double(b.most)));
}
