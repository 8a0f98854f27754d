#include "src/command/build.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "octree/build/kd/kd_builder.h"
#include "octree/build/stream/sampler.h"
#include "octree/build/stream/tree_builder.h"
#include "octree/core/error.h"
#include "octree/core/stopwatch.h"
#include "src/cli/cli.h"
#include "src/command/build_inputs.h"
#include "src/command/build_watch.h"
#include "src/json/json.h"
#include "src/run/peak_memory.h"

namespace stipple {
namespace {

struct BuildArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string memory = "4G";
  int threads = 0;
  std::string sampling = "poisson";
  std::string encoding = "DEFAULT";
  std::string partition = "octree";
  bool force = false;
  bool json = false;
};

StreamOptions stream_options(const BuildArguments& options) {
  StreamOptions stream;
  stream.memory = parse_bytes("--memory", options.memory, kLeastMemory);
  stream.threads = options.threads;
  if (options.sampling != "poisson" && options.sampling != "random")
    throw UsageError(fmt::format("--sampling: \"{}\" is neither poisson nor random", options.sampling));
  stream.sampling = options.sampling == "random" ? Sampling::random : Sampling::poisson;
  if (options.encoding != "DEFAULT" && options.encoding != "BROTLI")
    throw UsageError(fmt::format("--encoding: \"{}\" is neither DEFAULT nor BROTLI", options.encoding));
  stream.encoding = options.encoding == "BROTLI" ? potree2::Encoding::brotli : potree2::Encoding::uncompressed;
  stream.replace = options.force;
  if (options.partition != "octree" && options.partition != "kd")
    throw UsageError(fmt::format("--partition: \"{}\" is neither octree nor kd", options.partition));
  if (options.partition == "kd" && (options.sampling != "poisson" || options.encoding != "DEFAULT"))
    throw UsageError(
        "--partition kd: a kd tree samples nothing and has plain records; leave out --sampling and --encoding");
  return stream;
}

void print_as_json(const BuildArguments& options, const BuildReport& report, double seconds) {
  Json phases = Json::object();
  for (const PhaseTime& phase : report.phases) phases[std::string(name_of(phase.phase))] = phase.seconds;
  const double rate = seconds > 0.0 ? static_cast<double>(report.points) / seconds : 0.0;
  const Json document{{"phase", "done"},
                      {"path", options.output},
                      {"points", report.points},
                      {"nodes", report.nodes},
                      {"depth", report.depth},
                      {"spacing", report.spacing},
                      {"partition", options.partition},
                      {"sampling", options.partition == "kd" ? Json(nullptr) : Json(options.sampling)},
                      {"encoding", options.encoding},
                      {"grid", {{"scale", json_of(report.grid.scale)}, {"offset", json_of(report.grid.offset)}}},
                      {"largest_rounding", report.largest_rounding},
                      {"bytes_read", report.bytes_read},
                      {"bytes_written", report.bytes_written},
                      {"bytes_spilled", report.bytes_spilled},
                      {"peak_memory_bytes", peak_memory()},
                      {"seconds", seconds},
                      {"points_per_second", rate},
                      {"phase_seconds", phases}};
  fmt::print("{}\n", document.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void print_as_text(const BuildArguments& options, const BuildReport& report, double seconds) {
  fmt::print("{}: {} points in {} nodes on {} levels, {} bytes written, in {:.2f} s ({:.1f} M points/s)\n",
             options.output, with_thousands(report.points), with_thousands(report.nodes), report.depth + 1,
             with_thousands(report.bytes_written), seconds, static_cast<double>(report.points) / seconds * 1e-6);
  if (report.bytes_spilled > 0)
    fmt::print("{} bytes of them were set aside on the disk while building.\n", with_thousands(report.bytes_spilled));
}

void run(const BuildArguments& options) {
  const StreamOptions stream = stream_options(options);
  const Stopwatch stopwatch;
  const auto sources = open_inputs(options.inputs);
  BuildMonitor monitor;
  BuildReport report;
  {
    const StopOnSignal stop(monitor);
    const BuildWatch watch(monitor, options.json);
    report = options.partition == "kd" ? build_kd_tree(sources, options.output, stream, monitor)
                                       : build_tree(sources, options.output, stream, monitor);
  }
  const double seconds = stopwatch.seconds();
  if (report.largest_rounding > 0.0)
    warn(fmt::format("no common grid holds all files exactly; positions were moved by up to {} units",
                     report.largest_rounding));
  if (options.json)
    print_as_json(options, report, seconds);
  else
    print_as_text(options, report, seconds);
}

}  // namespace

void add_build_command(CLI::App& app) {
  const auto options = std::make_shared<BuildArguments>();
  CLI::App* command =
      app.add_subcommand("build", "Build an octree on disk (Potree 2.0) from point clouds of any size.");
  command->add_option("INPUT", options->inputs, "Point cloud files, octrees, or folders of files.")->required();
  command->add_option("-o,--output", options->output, "Folder of the tree; it appears when the tree is complete.")
      ->required();
  command
      ->add_option("--memory", options->memory,
                   "Memory to use at most, 128M or more, with k, M or G for powers of 1024 bytes. What does not fit is "
                   "set aside on the disk of the output.")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Threads to use; 0 for one a core.")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command
      ->add_option("--sampling", options->sampling,
                   "How inner nodes choose points. poisson: no two of a node are closer than its spacing, which is the "
                   "cube's edge / 128 / 2^level. random: one of each cell of 128^3 in a node; faster, but two points "
                   "may touch.")
      ->capture_default_str();
  command
      ->add_option(
          "--encoding", options->encoding,
          "How points are stored. DEFAULT: plain records, of which parts of a node can be read. BROTLI: packed "
          "node by node, for the network; smaller, and slower to build and to read.")
      ->capture_default_str();
  command
      ->add_option(
          "--partition", options->partition,
          "octree (Potree 2.0), or kd: a binary tree as of viewers that draw every point at every distance, split "
          "at the mean of the longest axis, all points in the leaves. It is for comparing the two, is read by "
          "this program alone, and is built in memory: a cloud that --memory has no room for is refused.")
      ->capture_default_str();
  command->add_flag("--force", options->force,
                    "Replace a tree that is already there. Other folders are never replaced.");
  command->add_flag("--json", options->json,
                    "Print a line of JSON to stdout each second while building, and one with the result; warnings "
                    "still go to stderr.");
  command->footer(
      "All attributes are kept. Files whose offsets or scales differ are put on one common grid, exactly where there\n"
      "is one; else the largest rounding is reported. A tree that is interrupted in any way leaves nothing behind but\n"
      "a folder \".DIR.stipple-build-...\", which the next build of DIR removes.\n\n"
      "Example:\n  stipple build tiles/ -o survey --memory 2G");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
