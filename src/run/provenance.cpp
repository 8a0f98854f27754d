#include "src/run/provenance.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <cmath>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <thread>

#include "render/raster/pixel_keys.h"
#include "src/cli/cli.h"

namespace stipple {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string system_name() {
  utsname name{};
  uname(&name);
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

}  // namespace

std::string text_of(const Json& document, int indent) {
  return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json program_provenance() {
  return {
      {"version", version()},
      {"machine", {{"cpu", cpu_name()}, {"cores", std::thread::hardware_concurrency()}, {"system", system_name()}}}};
}

Json context_provenance(const HeadlessContext& context) {
  return {{"gl_platform", context.platform()},
          {"gl_renderer", context.renderer()},
          {"gl_version", context.version()},
          {"gl_atomic_bits", has_64_bit_atomics() ? 64 : 32}};
}

Json dataset_provenance(const Dataset& dataset) {
  const PointSet& set = dataset.points;
  const WorldBox bounds = set.size() ? world_box(set.grid, set.bounds) : dataset.info.stated_bounds;
  return {{"path", dataset.info.path},
          {"format", dataset.info.format},
          {"points_total", dataset.info.point_count},
          {"points_hash", dataset.in_memory() ? Json(fmt::format("{:016x}", hash_points(set))) : Json()},
          {"color", dataset.colors.attribute},
          {"bounds", json_of(bounds)},
          {"grid", {{"offset", json_of(set.grid.offset)}, {"scale", json_of(set.grid.scale)}}}};
}

Json no_skip_json(const Skips& skips) {
  Json names = Json::array();
  for (const NamedSkip& skip : all_skips())
    if (!(skips.*skip.member)) names.push_back(skip.name);
  return names;
}

Json view_provenance(const View& view) {
  return {{"eye", json_of(view.eye)},
          {"right", json_of(view.right)},
          {"up", json_of(view.up)},
          {"forward", json_of(view.forward)},
          {"fov_deg", glm::degrees(2.0 * std::atan(1.0 / view.cot_y))},
          {"near", view.near},
          {"width", view.size.x},
          {"height", view.size.y}};
}

}  // namespace stipple
