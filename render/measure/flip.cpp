// Sections and equations are those of the paper that flip.h names.
#include "render/measure/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <vector>

#include "render/measure/lab.h"
#include "render/measure/row_filter.h"
#include "render/measure/same_size.h"

namespace stipple {
namespace {

constexpr double kPixelsPerDegree = 67.0;

// Table 1: contrast sensitivity a sqrt(pi / b) exp(-pi^2 d^2 / b) at d degrees, for each opponent channel.
struct Sensitivity {
  double a;
  double b;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047};
constexpr Sensitivity kRedGreen{1.0, 0.0053};
constexpr Sensitivity kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};

constexpr float kColorExponent = 0.7f;    // q_c, section 4.1.3
constexpr float kCut = 0.4f;              // p_c
constexpr float kCutTo = 0.95f;           // p_t
constexpr double kFeatureWidth = 0.082;   // w in degrees, section 4.2
constexpr float kFeatureExponent = 0.5f;  // q_f

double sigma_of(const Sensitivity& s) {
  return std::sqrt(s.b / 2.0) / glm::pi<double>() * kPixelsPerDegree;
}

// First and second derivative of a Gaussian, each scaled so that its positive weights sum to 1 and its negative to -1
// (equations 14 and 15).
template <class Derivative>
Taps feature_taps(int radius, const Derivative& derivative) {
  double positive = 0.0;
  double negative = 0.0;
  for (int x = -radius; x <= radius; ++x) {
    positive += std::max(derivative(x), 0.0);
    negative -= std::min(derivative(x), 0.0);
  }
  Taps taps;
  for (int x = -radius; x <= radius; ++x) {
    const double value = derivative(x);
    taps.push_back(static_cast<float>(value / (value > 0.0 ? positive : negative)));
  }
  return taps;
}

// All windows are products of a filter along and one across; blue-yellow is the sum of two such.
struct Filters {
  int margin;  // the largest radius
  Taps achromatic, red_green, blue_yellow[2];
  Taps blue_yellow_across[2];  // with the share of each of the two
  Taps smooth, edge, point;

  Filters() {
    // Three deviations of the widest window, for all channels
    const int csf_radius = static_cast<int>(std::ceil(3.0 * sigma_of(kBlueYellow[0])));
    achromatic = gaussian_taps(sigma_of(kAchromatic), csf_radius);
    red_green = gaussian_taps(sigma_of(kRedGreen), csf_radius);
    double share[2];
    for (int i = 0; i < 2; ++i) {
      const double sigma = sigma_of(kBlueYellow[i]);
      blue_yellow[i] = gaussian_taps(sigma, csf_radius);
      // The sum of the window before it was scaled to 1; that of one direction is 1 / the middle weight
      const double sum = 1.0 / blue_yellow[i][static_cast<std::size_t>(csf_radius)];
      share[i] = kBlueYellow[i].a * std::sqrt(glm::pi<double>() / kBlueYellow[i].b) * sum * sum;
    }
    for (int i = 0; i < 2; ++i) {
      blue_yellow_across[i] = blue_yellow[i];
      for (float& tap : blue_yellow_across[i]) tap *= static_cast<float>(share[i] / (share[0] + share[1]));
    }
    const double sigma = 0.5 * kFeatureWidth * kPixelsPerDegree;
    const int feature_radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto g = [sigma](int x) { return std::exp(-0.5 * x * x / (sigma * sigma)); };
    smooth = gaussian_taps(sigma, feature_radius);
    edge = feature_taps(feature_radius, [&](int x) { return -x * g(x); });
    point = feature_taps(feature_radius, [&](int x) { return (x * x / (sigma * sigma) - 1.0) * g(x); });
    margin = std::max(csf_radius, feature_radius);
  }
};

// What does not depend on the pictures.
struct Constants {
  Filters filters;
  std::array<float, 256> linear_of_srgb = linear_of_srgb_table();
  glm::mat3 xyz_from_rgb = relative_xyz_from_rgb();
  glm::mat3 rgb_from_xyz = glm::inverse(glm::dmat3(relative_xyz_from_rgb()));
  float largest_color_error;  // between green and blue, which differ most

  Constants() {
    const glm::vec3 green = hunt_adjusted(lab_of(xyz_from_rgb[1]));
    const glm::vec3 blue = hunt_adjusted(lab_of(xyz_from_rgb[2]));
    largest_color_error = std::pow(hyab(green, blue), kColorExponent);
  }
};

const Constants& constants() {
  static const Constants instance;
  return instance;
}

// A row as the eye has it.
struct PerceivedRow {
  explicit PerceivedRow(int width)
      : lightness(static_cast<std::size_t>(width)), a(lightness), b(lightness), edge(lightness), point(lightness) {}
  std::vector<float> lightness, a, b, edge, point;
};

// Some rows of a picture, filtered along; gives each row filtered across, too.
class Band {
 public:
  Band(const Image& image, int first, int last)
      : width_(image.size.x),
        first_(first),
        count_(last - first + 2 * constants().filters.margin),
        sum_(static_cast<std::size_t>(width_)),
        other_(sum_) {
    const Filters& filters = constants().filters;
    const Taps* taps[] = {&filters.achromatic, &filters.red_green, &filters.blue_yellow[0], &filters.blue_yellow[1],
                          &filters.smooth,     &filters.edge,      &filters.point};
    const int channels[] = {0, 1, 2, 2, 0, 0, 0};
    along_.assign(kPlanes, Rows(width_, count_, 0));
    Rows opponent(width_, 3, filters.margin);
    int source = -1;
    for (int i = 0; i < count_; ++i) {
      const int y = std::clamp(first - filters.margin + i, 0, image.size.y - 1);
      if (y != source) fill_opponent(image, y, opponent);
      source = y;
      for (std::size_t p = 0; p < kPlanes; ++p)
        filter_along(opponent.row(channels[p]), width_, *taps[p], along_[p].row(i));
    }
  }

  // Row `y` of the picture, from first to last - 1.
  void perceive(int y, PerceivedRow& out) {
    const int center = y - first_ + constants().filters.margin;
    perceive_color(center, out);
    const Filters& filters = constants().filters;
    perceive_feature(center, kEdge, filters.edge, out.edge);
    perceive_feature(center, kPoint, filters.point, out.point);
  }

 private:
  enum Plane { kLuminance, kRedGreenPlane, kBlueYellow1, kBlueYellow2, kSmooth, kEdge, kPoint, kPlanes };

  // YCxCz (equation 2) up to scale and offset, which filters whose weights sum to one leave alone: y, x - y, y - z.
  void fill_opponent(const Image& image, int y, Rows& opponent) const {
    const Constants& c = constants();
    const std::uint8_t* rgb = &image.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) * 3];
    for (int x = 0; x < width_; ++x, rgb += 3) {
      const glm::vec3 xyz =
          c.xyz_from_rgb * glm::vec3(c.linear_of_srgb[rgb[0]], c.linear_of_srgb[rgb[1]], c.linear_of_srgb[rgb[2]]);
      opponent.row(0)[x] = xyz.y;
      opponent.row(1)[x] = xyz.x - xyz.y;
      opponent.row(2)[x] = xyz.y - xyz.z;
    }
    for (int i = 0; i < 3; ++i) opponent.extend(i);
  }

  void across(int center, Plane plane, const Taps& taps, std::vector<float>& out) const {
    std::ranges::fill(out, 0.0f);
    add_filtered_across(along_[plane], center, taps, out.data());
  }

  // Section 4.1: filtered, back to RGB and cut to what a monitor shows, then L*a*b* with the Hunt effect.
  void perceive_color(int center, PerceivedRow& out) const {
    const Constants& c = constants();
    across(center, kLuminance, c.filters.achromatic, out.lightness);
    across(center, kRedGreenPlane, c.filters.red_green, out.a);
    across(center, kBlueYellow1, c.filters.blue_yellow_across[0], out.b);
    add_filtered_across(along_[kBlueYellow2], center, c.filters.blue_yellow_across[1], out.b.data());
    for (std::size_t x = 0; x < out.lightness.size(); ++x) {
      const float y = out.lightness[x];
      const glm::vec3 rgb = c.rgb_from_xyz * glm::vec3(y + out.a[x], y, y - out.b[x]);
      const glm::vec3 shown = c.xyz_from_rgb * glm::clamp(rgb, 0.0f, 1.0f);
      const glm::vec3 lab = hunt_adjusted(lab_of(shown));
      out.lightness[x] = lab.x;
      out.a[x] = lab.y;
      out.b[x] = lab.z;
    }
  }

  // Section 4.2: the length of the feature's gradient, its two parts filtered one along and one across.
  void perceive_feature(int center, Plane along, const Taps& taps, std::vector<float>& out) {
    const Filters& filters = constants().filters;
    across(center, along, filters.smooth, sum_);
    across(center, kSmooth, taps, other_);
    for (std::size_t x = 0; x < out.size(); ++x) out[x] = std::sqrt(sum_[x] * sum_[x] + other_[x] * other_[x]);
  }

  int width_;
  int first_;
  int count_;
  std::vector<Rows> along_;
  std::vector<float> sum_;
  std::vector<float> other_;
};

// Section 4.1.3: the power of the distance, spread so that its lower part takes most of 0 to 1.
float color_error(float distance) {
  const float error = std::pow(distance, kColorExponent);
  const float largest = constants().largest_color_error;
  const float cut = kCut * largest;
  if (error < cut) return kCutTo / cut * error;
  return kCutTo + (error - cut) / (largest - cut) * (1.0f - kCutTo);
}

double sum_of_row(const PerceivedRow& test, const PerceivedRow& reference) {
  double total = 0.0;
  for (std::size_t x = 0; x < test.lightness.size(); ++x) {
    const float distance =
        hyab({test.lightness[x], test.a[x], test.b[x]}, {reference.lightness[x], reference.a[x], reference.b[x]});
    const float feature =
        std::max(std::abs(test.edge[x] - reference.edge[x]), std::abs(test.point[x] - reference.point[x])) /
        std::sqrt(2.0f);
    // Section 4.3: features make differences of colour count for more
    if (distance > 0.0f)
      total += static_cast<double>(std::pow(color_error(distance), 1.0f - std::pow(feature, kFeatureExponent)));
  }
  return total;
}

}  // namespace

double flip(const Image& test, const Image& reference) {
  require_same_size(test.size, reference.size);
  if (test.rgb.empty()) return 0.0;
  std::vector<double> sums(static_cast<std::size_t>((test.size.y + kBandRows - 1) / kBandRows));
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t band) {
    const int first = static_cast<int>(band) * kBandRows;
    const int last = std::min(first + kBandRows, test.size.y);
    Band of_test(test, first, last);
    Band of_reference(reference, first, last);
    PerceivedRow test_row(test.size.x);
    PerceivedRow reference_row(test.size.x);
    for (int y = first; y < last; ++y) {
      of_test.perceive(y, test_row);
      of_reference.perceive(y, reference_row);
      sums[band] += sum_of_row(test_row, reference_row);
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(test.rgb.size() / 3);
}

}  // namespace stipple
