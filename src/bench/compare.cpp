#include "src/bench/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "octree/core/error.h"

namespace stipple {
namespace {

// What two runs must share for their times to be comparable.
constexpr std::array kSettings{"/machine", "/gl_renderer", "/dataset/format", "/dataset/points_total",
                               "/size",    "/budget",      "/repeats"};

std::vector<double> runs_of(const Json& part, const std::string& path) {
  const auto runs = part.find("runs_ms");
  if (runs == part.end() || !runs->is_array() || runs->empty() || !part.contains("median_ms"))
    throw Error(fmt::format("{}: part \"{}\" has no \"runs_ms\"; a document of `stipple bench --json` was expected.",
                            path, part.value("part", "")));
  return runs->get<std::vector<double>>();
}

// Of parts that are a quality reached, and were; nothing else has points that may differ.
std::optional<PointsMove> points_moved(const Json& before, const Json& now) {
  if (now.value("unit", "") != "points drawn" || before.value("unit", "") != "points drawn") return std::nullopt;
  const PointsMove move{now.at("part"), before.value("amount", 0.0), now.at("amount")};
  return move.old_points == move.new_points ? std::nullopt : std::optional(move);
}

const Json* find_part(const Json& parts, const std::string& name) {
  const auto found = std::ranges::find_if(parts, [&](const Json& part) { return part.value("part", "") == name; });
  return found == parts.end() ? nullptr : &*found;
}

bool apart(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::max(a) < std::ranges::min(b) || std::ranges::max(b) < std::ranges::min(a);
}

std::vector<std::string> differences(const Json& old_document, const Json& new_document) {
  std::vector<std::string> found;
  for (const char* place : kSettings) {
    const Json::json_pointer pointer(place);
    const Json before = old_document.value(pointer, Json());
    const Json now = new_document.value(pointer, Json());
    if (before != now) found.push_back(fmt::format("{} was {} and is {}", place + 1, before.dump(), now.dump()));
  }
  return found;
}

}  // namespace

BenchComparison compare_benches(const Json& old_document, const Json& new_document, const std::string& old_path) {
  if (!old_document.is_object() || !old_document.contains("parts") || !old_document["parts"].is_array())
    throw Error(fmt::format("{}: has no \"parts\"; a document of `stipple bench --json` was expected.", old_path));
  BenchComparison comparison;
  comparison.differences = differences(old_document, new_document);
  for (const Json& now : new_document.at("parts")) {
    const std::string name = now.at("part");
    const Json* const before = find_part(old_document["parts"], name);
    if (!before) continue;
    ++comparison.compared;
    if (const auto move = points_moved(*before, now)) comparison.other_points.push_back(*move);
    if (apart(runs_of(*before, old_path), runs_of(now, "this run")))
      comparison.moved.push_back({name, before->at("median_ms"), now.at("median_ms")});
  }
  return comparison;
}

}  // namespace stipple
