#include "src/command/info.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "octree/read/open.h"
#include "src/cli/cli.h"
#include "src/json/json.h"

namespace stipple {
namespace {

struct Options {
  std::string input;
  bool json = false;
};

// Empty for what is not a regular file.
std::optional<std::uint64_t> file_bytes(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  return bytes;
}

std::optional<double> bytes_per_point(std::optional<std::uint64_t> bytes, std::uint64_t points) {
  if (!bytes || points == 0) return std::nullopt;
  return static_cast<double>(*bytes) / static_cast<double>(points);
}

template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void print_as_json(const SourceInfo& info) {
  Json attributes = Json::array();
  for (const Attribute& attribute : info.schema) attributes.push_back(json_of(attribute));
  const auto bytes = file_bytes(info.path);
  print_json({{"path", info.path},
              {"format", info.format},
              {"version", info.version},
              {"encoding", info.encoding},
              {"points", info.point_count},
              {"file_bytes", json_or_null(bytes)},
              {"bytes_per_point", json_or_null(bytes_per_point(bytes, info.point_count))},
              {"grid", {{"scale", json_of(info.grid.scale)}, {"offset", json_of(info.grid.offset)}}},
              {"stated_bounds", json_of(info.stated_bounds)},
              {"attributes", attributes},
              {"warnings", info.warnings}});
}

std::string text_of(const glm::dvec3& v) {
  return fmt::format("{}  {}  {}", v.x, v.y, v.z);
}

void print_line(std::string_view label, std::string_view value) {
  fmt::print("{:<15}{}\n", label, value);
}

void print_as_text(const SourceInfo& info) {
  print_line("path", info.path);
  print_line("format", fmt::format("{} {}", info.format, info.version));
  print_line("encoding", info.encoding);
  print_line("points", with_thousands(info.point_count));
  const auto bytes = file_bytes(info.path);
  if (bytes) print_line("file size", fmt::format("{} bytes", with_thousands(*bytes)));
  if (const auto each = bytes_per_point(bytes, info.point_count))
    print_line("", fmt::format("{:.2f} bytes a point, header included", *each));
  print_line("grid scale", text_of(info.grid.scale));
  print_line("grid offset", text_of(info.grid.offset));
  if (info.stated_bounds.empty()) {
    print_line("stated bounds", "none");
  } else {
    print_line("stated min", text_of(info.stated_bounds.min));
    print_line("stated max", text_of(info.stated_bounds.max));
  }
  std::string_view label = "attributes";
  for (const Attribute& attribute : info.schema) {
    const std::string count = attribute.components > 1 ? fmt::format(" x {}", attribute.components) : "";
    print_line(label, fmt::format("{:<20} {}{}", attribute.name, name_of(attribute.type), count));
    label = "";
  }
  if (info.schema.empty()) print_line(label, "none");
}

void run(const Options& options) {
  const auto source = open_source(options.input);
  const SourceInfo& info = source->info();
  for (const std::string& warning : info.warnings) warn(fmt::format("{}: {}", info.path, warning));
  if (options.json)
    print_as_json(info);
  else
    print_as_text(info);
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "Say what a point cloud file holds, without decoding its points.");
  command->add_option("INPUT", options->input, "Point cloud file.")->required();
  add_json_flag(*command, options->json);
  command->footer(
      "Prints the format, the number of points, the integer grid that positions lie on (scale and offset in the "
      "cloud's\n"
      "own units), the bounds that the header states, and the attributes with their types. What the file is, is found\n"
      "out by its content, not by its name. In JSON, what the file does not say is null.\n\n"
      "Example:\n  stipple info autzen.las --json");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
