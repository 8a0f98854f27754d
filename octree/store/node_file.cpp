#include "octree/store/node_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

#include "octree/core/error.h"
#include "octree/read/open.h"

namespace stipple {
namespace {

// A decimal scale is off by its rounding only: 0.001 / (0.001 / 32) is to be 32.
constexpr double kRounding = 1e-9;

double snap(double value) {
  const double whole = std::round(value);
  return std::abs(value - whole) <= kRounding * std::max(1.0, std::abs(value)) ? whole : value;
}

void check_there(const std::string& path, const std::string& expected) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw Error(fmt::format("{}: there is no such file, and {} were expected in it. Copy or download the tree again.",
                            path, expected));
}

std::unique_ptr<PointSource> open_las_node(const std::string& path, const std::string& expected) {
  check_there(path, expected);
  auto source = open_file(path);
  if (source->info().format != "LAS" && source->info().format != "LAZ")
    throw Error(fmt::format("{}: is a {} file, and LAS or LAZ was expected.", path, source->info().format));
  if (source->info().point_count > kMaxLasNodePoints)
    throw Error(fmt::format("{}: the header states {} points; at most {} are read in one node. The file is damaged.",
                            path, source->info().point_count, kMaxLasNodePoints));
  return source;
}

// Where the attributes are in the file's own schema.
std::vector<std::size_t> find_all(const Schema& schema, std::span<const std::size_t> attributes,
                                  const SourceInfo& file) {
  std::vector<std::size_t> found;
  for (const std::size_t index : attributes) {
    const Attribute& wanted = schema.at(index);
    const auto place = find_attribute(file.schema, wanted.name);
    if (!place || file.schema[*place] != wanted)
      throw Error(
          fmt::format("{}: {} x {} \"{}\" was expected of its points as in the other nodes. The tree is damaged; "
                      "build or copy it again.",
                      file.path, wanted.components, name_of(wanted.type), wanted.name));
    found.push_back(*place);
  }
  return found;
}

void copy_batch(const PointBatch& from, PointBatch& to) {
  if (from.positions.empty()) return;
  std::memcpy(to.positions.data() + from.first, from.positions.data(), from.positions.size() * sizeof(glm::ivec3));
  for (std::size_t c = 0; c < from.columns.size(); ++c)
    std::memcpy(to.columns[c].bytes.data() + from.first * to.columns[c].attribute.bytes(), from.columns[c].bytes.data(),
                from.columns[c].bytes.size());
}

}  // namespace

GridChange::GridChange(const Grid& from, const Grid& to)
    : factor_(from.scale / to.scale), shift_((from.offset - to.offset) / to.scale) {
  for (int axis = 0; axis < 3; ++axis) factor_[axis] = snap(factor_[axis]);
}

void GridChange::apply(std::span<glm::ivec3> positions) const {
  if (factor_ == glm::dvec3(1.0) && shift_ == glm::dvec3(0.0)) return;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  for (glm::ivec3& position : positions) {
    const glm::dvec3 moved = glm::floor(shift_ + factor_ * glm::dvec3(position) + 0.5);
    if (!glm::all(glm::lessThanEqual(glm::abs(moved), glm::dvec3(kMost))))
      throw Error("a point is too far outside the tree's cube for its grid");
    position = glm::ivec3(moved);
  }
}

InputFile open_node_file(const std::string& path, const std::string& expected) {
  check_there(path, expected);
  return InputFile(path);
}

void clear_batch(const Schema& schema, std::span<const std::size_t> attributes, PointBatch& batch) {
  batch.positions.clear();
  batch.columns.clear();
  for (const std::size_t index : attributes) batch.columns.push_back({schema.at(index), {}});
}

SourceInfo las_node_info(const std::string& path, const std::string& expected) {
  return open_las_node(path, expected)->info();
}

void read_las_node(const std::string& path, const std::string& expected, const Schema& schema,
                   std::span<const std::size_t> attributes, const Grid& grid, PointBatch& batch) {
  const auto source = open_las_node(path, expected);
  const SourceInfo& info = source->info();
  const std::vector<std::size_t> in_file = find_all(schema, attributes, info);
  batch.positions.resize(info.point_count);
  batch.columns.resize(attributes.size());
  for (std::size_t c = 0; c < attributes.size(); ++c) {
    batch.columns[c].attribute = schema[attributes[c]];
    batch.columns[c].resize(info.point_count);
  }
  source->read(in_file, [&batch](const PointBatch& part) { copy_batch(part, batch); });
  try {
    GridChange(info.grid, grid).apply(batch.positions);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}. The file is damaged; copy it again.", path, error.what()));
  }
}

}  // namespace stipple
