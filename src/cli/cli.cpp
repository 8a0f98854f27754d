#include "src/cli/cli.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "octree/core/error.h"

namespace stipple {
namespace {

enum ExitCode : int { kDone = 0, kFailed = 1, kWrongUsage = 2 };

int report_wrong_usage(const CLI::App& app, std::string_view message) {
  std::string command = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
  fmt::print(stderr, "stipple: {}\nRun `{} --help` for what it takes.\n", message, command);
  return kWrongUsage;
}

// CLI11 complains of a missing argument before an unknown one, which is the likelier slip: name both.
std::string message_of(const CLI::ParseError& error, const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty() || dynamic_cast<const CLI::ExtrasError*>(&error)) return error.what();
  return fmt::format("{} was not expected; {}", unknown.front(), error.what());
}

int parse_and_run(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& e) {
    return report_wrong_usage(app, message_of(e, app));
  }
  if (app.get_subcommands().empty()) {
    fmt::print(stderr, "{}", app.help());
    return kWrongUsage;
  }
  return kDone;
}

}  // namespace

std::string_view version() {
  return STIPPLE_VERSION;
}

int run_program(CLI::App& app, int argc, const char* const* argv) {
  try {
    const int code = parse_and_run(app, argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw system_error("standard output", "cannot be written");
    return code;
  } catch (const UsageError& e) {
    return report_wrong_usage(app, e.what());
  } catch (const std::exception& e) {
    fmt::print(stderr, "stipple: {}\n", e.what());
    return kFailed;
  }
}

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print the result as one JSON document on stdout; warnings still go to stderr.");
}

void warn(std::string_view message) {
  fmt::print(stderr, "stipple: warning: {}\n", message);
}

}  // namespace stipple
