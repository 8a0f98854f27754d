#include "src/command/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

#include "octree/core/error.h"
#include "render/measure/flip.h"
#include "render/measure/psnr.h"
#include "render/measure/ssim.h"
#include "src/cli/cli.h"
#include "src/json/json.h"

namespace stipple {
namespace {

struct CompareArguments {
  std::string test;
  std::string reference;
  bool json = false;
};

struct Difference {
  std::uint64_t pixels = 0;  // that differ in any channel
  int largest = 0;           // of all channels, 0 to 255
};

Difference difference_of(const Image& a, const Image& b) {
  Difference out;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int largest = 0;
    for (std::size_t c = i; c < i + 3; ++c) largest = std::max(largest, std::abs(a.rgb[c] - b.rgb[c]));
    if (largest > 0) ++out.pixels;
    out.largest = std::max(out.largest, largest);
  }
  return out;
}

void run(const CompareArguments& options) {
  const Image test = read_png(options.test);
  const Image reference = read_png(options.reference);
  if (test.size != reference.size)
    throw Error(fmt::format("{} has {}x{} pixels and {} has {}x{}; only pictures of one size can be compared",
                            options.test, test.size.x, test.size.y, options.reference, reference.size.x,
                            reference.size.y));
  const double mse = mean_squared_error(test, reference);
  const std::optional<double> similarity = ssim(test, reference);
  const double seen = flip(test, reference);
  const Difference difference = difference_of(test, reference);
  const std::uint64_t pixels = test.rgb.size() / 3;
  if (options.json) {
    print_json({{"test", options.test},
                {"reference", options.reference},
                {"width", test.size.x},
                {"height", test.size.y},
                {"psnr_db", json_of_any(psnr_db(mse))},
                {"ssim", similarity ? Json(*similarity) : Json()},
                {"flip", seen},
                {"mse", mse},
                {"different_pixels", difference.pixels},
                {"largest_difference", difference.largest}});
    return;
  }
  fmt::print("PSNR                {:.4f} dB\n", psnr_db(mse));
  fmt::print("SSIM                {}\n", similarity ? fmt::format("{:.6f}", *similarity) : "- (needs 11x11 pixels)");
  fmt::print("FLIP                {:.6f}\n", seen);
  fmt::print("mean squared error  {:.6g}\n", mse);
  fmt::print("different pixels    {} of {}\n", with_thousands(difference.pixels), with_thousands(pixels));
  fmt::print("largest difference  {} of 255\n", difference.largest);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  const auto options = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Measure how far one picture is from another.");
  command->add_option("TEST", options->test, "PNG file to be judged.")->required();
  command->add_option("REFERENCE", options->reference, "PNG file of the same size to judge it by.")->required();
  add_json_flag(*command, options->json);
  command->footer(
      "Prints, over all pixels and the three channels:\n"
      "  PSNR   peak signal-to-noise ratio in dB; inf for identical pictures\n"
      "  SSIM   structural similarity (Wang and others 2004), 11x11 Gaussian window: at most 1, which is identical;\n"
      "         as scikit-image computes it. Pictures smaller than the window have none (null in JSON)\n"
      "  FLIP   what is seen when the two are flipped between (Andersson and others 2020), mean at 67 pixels per\n"
      "         degree: 0 (nothing) to 1\n"
      "and the mean squared error (0 to 65025), the number of pixels that differ, and the largest difference of a "
      "channel\n"
      "(0 to 255). Alpha is ignored. JSON has no infinity: there it is the string \"inf\". Differing pictures are a\n"
      "result, not a failure: the exit code is 0.\n\n"
      "Example:\n  stipple compare hybrid.png reference.png --json");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
