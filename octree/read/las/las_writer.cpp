#include "octree/read/las/las_writer.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <vector>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "octree/read/las/las_format.h"
#include "octree/read/las/las_header_block.h"

namespace stipple {
namespace {

constexpr std::array<std::string_view, 6> kWritten{"intensity",      "return number", "number of returns",
                                                   "classification", "gps-time",      "rgb"};

// Return number (three bits) and number of returns (the next three) stand in one byte.
constexpr std::size_t kReturns = 14;
constexpr unsigned kReturnNumberMask = 7;
constexpr std::byte kReturnNumberOne{1};
constexpr std::byte kOneReturn{1 << 3};

// Which attribute of the source goes where in a record.
struct Plan {
  int point_format = 0;
  std::vector<std::size_t> attributes;  // indices into the source's schema
  std::vector<las::Field> fields;       // one for each of `attributes`
  std::byte returns{0};                 // what the source does not say of them
};

Plan make_plan(const SourceInfo& info, const std::string& path) {
  Plan plan;
  const bool has_time = find_attribute(info.schema, "gps-time").has_value();
  const bool has_rgb = find_attribute(info.schema, "rgb").has_value();
  plan.point_format = (has_time ? 1 : 0) + (has_rgb ? 2 : 0);
  if (!find_attribute(info.schema, "return number")) plan.returns |= kReturnNumberOne;
  if (!find_attribute(info.schema, "number of returns")) plan.returns |= kOneReturn;

  for (const las::Field& field : las::point_fields(plan.point_format)) {
    const std::string& name = field.attribute.name;
    const auto index = find_attribute(info.schema, name);
    if (!index || std::ranges::find(kWritten, name) == kWritten.end()) continue;
    if (info.schema[*index] != field.attribute)
      throw Error(
          fmt::format("{}: cannot be written from {}: its attribute \"{}\" is {} x {} (scale {}, offset {}), and "
                      "{} x {}, unscaled, was expected.",
                      path, info.path, name, name_of(info.schema[*index].type), info.schema[*index].components,
                      info.schema[*index].scale, info.schema[*index].offset, name_of(field.attribute.type),
                      field.attribute.components));
    plan.attributes.push_back(*index);
    plan.fields.push_back(field);
  }
  return plan;
}

// What one thread gathers and reuses.
struct Tally {
  Buffer<std::byte> records;
  GridBox box;
  std::array<std::uint64_t, kReturnNumberMask + 1> counts_by_return{};
  std::uint64_t points = 0;
};

void scatter_bits(const las::Field& field, const Column& column, std::size_t stride, std::byte* out,
                  const std::string& path) {
  const std::span<const std::uint8_t> values = column.as<std::uint8_t>();
  const unsigned limit = 1u << field.bits;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= limit)
      throw Error(
          fmt::format("{}: cannot be written: a point has {} {}, and a LAS file of point formats 0 to 3 holds 0 "
                      "to {}. Change the value in the source.",
                      path, field.attribute.name, values[i], limit - 1));
    out[i * stride] |= static_cast<std::byte>(values[i] << field.shift);
  }
}

template <std::size_t kSize>
void scatter(const std::byte* in, std::size_t count, std::size_t stride, std::byte* out) {
  for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * stride, in + i * kSize, kSize);
}

void scatter_whole(const Column& column, std::size_t stride, std::byte* out) {
  const std::byte* const in = column.bytes.data();
  switch (column.attribute.bytes()) {
    case 2:
      return scatter<2>(in, column.points(), stride, out);  // intensity
    case 6:
      return scatter<6>(in, column.points(), stride, out);  // rgb
    case 8:
      return scatter<8>(in, column.points(), stride, out);  // gps-time
  }
}

void encode(const PointBatch& batch, const Plan& plan, const std::string& path, Tally& tally) {
  const std::size_t stride = las::record_size(plan.point_format);
  const std::size_t count = batch.positions.size();
  tally.records.assign(count * stride, std::byte{0});
  std::byte* const records = tally.records.data();

  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(records + i * stride, &batch.positions[i], sizeof(glm::ivec3));
    records[i * stride + kReturns] = plan.returns;
    tally.box.extend(batch.positions[i]);
  }
  for (std::size_t c = 0; c < plan.fields.size(); ++c) {
    std::byte* const out = records + plan.fields[c].offset;
    if (plan.fields[c].bits != 0)
      scatter_bits(plan.fields[c], batch.columns[c], stride, out, path);
    else
      scatter_whole(batch.columns[c], stride, out);
  }
  for (std::size_t i = 0; i < count; ++i)
    ++tally.counts_by_return[std::to_integer<unsigned>(records[i * stride + kReturns]) & kReturnNumberMask];
  tally.points += count;
}

las::HeaderContent summarize(const SourceInfo& info, const Plan& plan, const std::string& path,
                             const tbb::enumerable_thread_specific<Tally>& tallies) {
  las::HeaderContent content;
  content.point_format = plan.point_format;
  content.grid = info.grid;
  GridBox box;
  for (const Tally& tally : tallies) {
    content.point_count += tally.points;
    box.extend(tally.box);
    // Return number 0 means that the number is not known; no count is kept of it
    for (std::size_t r = 1; r <= kReturnNumberMask; ++r) content.counts_by_return[r - 1] += tally.counts_by_return[r];
  }
  if (content.point_count != info.point_count)
    throw Error(fmt::format("{}: cannot be written: {} promised {} points and delivered {}.", path, info.path,
                            info.point_count, content.point_count));
  if (!box.empty()) content.bounds = world_box(info.grid, box);
  return content;
}

}  // namespace

void write_las(const PointSource& source, const std::string& path) {
  const SourceInfo& info = source.info();
  const Plan plan = make_plan(info, path);
  const std::size_t record_length = las::record_size(plan.point_format);
  OutputFile file(path);

  tbb::enumerable_thread_specific<Tally> tallies;
  source.read(plan.attributes, [&](const PointBatch& batch) {
    if (batch.first > info.point_count || batch.positions.size() > info.point_count - batch.first)
      throw Error(fmt::format("{}: cannot be written: {} promised {} points and delivered points {} to {}.", path,
                              info.path, info.point_count, batch.first, batch.first + batch.positions.size()));
    Tally& tally = tallies.local();
    encode(batch, plan, path, tally);
    file.write_at(las::kWrittenHeaderSize + batch.first * record_length, tally.records);
  });
  file.write_at(0, las::header_block(summarize(info, plan, path, tallies)));
  file.commit();
}

}  // namespace stipple
