#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "octree/build/stream/tree_builder.h"
#include "octree/open/open.h"
#include "src/bench/parts.h"

namespace stipple {
namespace {

constexpr std::uint64_t kLittleMemory = std::uint64_t{512} << 20;  // from here on the memory of a build is to stay flat

struct Variant {
  const char* name;
  Sampling sampling;
  std::uint64_t memory;
};

constexpr std::array kVariants{
    Variant{"poisson", Sampling::poisson, StreamOptions{}.memory},
    Variant{"random", Sampling::random, StreamOptions{}.memory},
    Variant{"poisson, 512M", Sampling::poisson, kLittleMemory},
};

// A folder of our own, gone with the object.
class TemporaryTree {
 public:
  TemporaryTree() : path_(std::filesystem::temp_directory_path() / fmt::format("stipple-bench-{}-tree", ::getpid())) {}
  ~TemporaryTree() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryTree(const TemporaryTree&) = delete;
  TemporaryTree& operator=(const TemporaryTree&) = delete;
  std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// What the last run did, beside its time.
void describe(const BuildReport& report, Timing& timing) {
  double seconds = 0.0;
  for (const PhaseTime& phase : report.phases) seconds += phase.seconds;
  std::array<double, 4> shares{};
  for (const PhaseTime& phase : report.phases) shares[static_cast<std::size_t>(phase.phase)] += phase.seconds / seconds;
  for (std::size_t p = 0; p < shares.size(); ++p) {
    const std::string_view name = name_of(static_cast<BuildPhase>(p));
    timing.details["phase_shares"][std::string(name)] = shares[p];
    timing.remark += fmt::format("{} {:.0f} %, ", name, 100.0 * shares[p]);
  }
  timing.details["bytes_read"] = report.bytes_read;
  timing.details["bytes_written"] = report.bytes_written;
  timing.details["bytes_spilled"] = report.bytes_spilled;
  timing.remark +=
      fmt::format("{:.2f} GB read, {:.2f} GB written, {:.2f} GB of them set aside meanwhile",
                  static_cast<double>(report.bytes_read) * 1e-9, static_cast<double>(report.bytes_written) * 1e-9,
                  static_cast<double>(report.bytes_spilled) * 1e-9);
}

}  // namespace

void bench_building(const PointSource& source, const BenchSettings& settings, const TimingSink& sink) {
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(open_source(source.info().path));
  for (const Variant& variant : kVariants) {
    const TemporaryTree tree;
    StreamOptions options;
    options.sampling = variant.sampling;
    options.memory = variant.memory;
    BuildReport report;
    // Removing the last tree is no part of building one
    const auto before = [&] { std::filesystem::remove_all(tree.path()); };
    Timing timing = time_part(
        fmt::format("build tree on disk, {}", variant.name), static_cast<double>(source.info().point_count), "points",
        std::min(settings.repeats, 3),
        [&] {
          BuildMonitor monitor;
          report = build_tree(sources, tree.path(), options, monitor);
        },
        before);
    describe(report, timing);
    sink(timing);
  }
}

}  // namespace stipple
