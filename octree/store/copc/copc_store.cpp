#include "octree/store/copc/copc_store.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/laz/chunk_reader.h"
#include "octree/store/node_file.h"

namespace stipple {
namespace {

// Writers pick the cell before they round the point to the grid, or the other way round, on a cube whose corners need
// not be on it: in lion_takanawa.copc.laz of the Potree project, points are up to 0.5 grid steps outside.
constexpr double kCellMargin = 1.0;

las::Header load_header(const InputFile& file) {
  las::Header header = las::parse_header(file.map().bytes(), file.path());
  if (!header.compressed || header.point_format < 6)
    throw file_error(
        file.path(), las::kPointFormat,
        fmt::format("point format {}{} was found, and a compressed one from 6 to 10 was expected in a COPC "
                    "file. The file is damaged; copy it again.",
                    header.point_format, header.compressed ? "" : ", not compressed,"));
  return header;
}

copc::Info load_info(const InputFile& file, const las::Header& header) {
  const las::Record* const record = las::find_record(header.records, copc::kUserId, copc::kInfoRecord);
  if (!record)
    throw file_error(
        file.path(), copc::kInfoRecordAt,
        fmt::format("the record \"{}\" was expected here. The file is damaged; copy it again.", copc::kUserId));
  std::array<std::byte, copc::kInfoBytes> body{};
  const auto bytes = std::span(body).first(std::min<std::uint64_t>(body.size(), record->size));
  file.read_at(record->begin, bytes);
  return copc::parse_info(bytes, record->begin, file.path());
}

AttributeRange range_of(double min, double max) {
  AttributeRange range;
  range.min = {min};
  range.max = {max};
  return range;
}

TreeInfo describe(const las::Header& header, const laz::Format& format, const copc::Info& copc,
                  const std::string& path) {
  TreeInfo info;
  info.source = las::source_info(header, path, "COPC");
  info.source.encoding = fmt::format("LAZ {}, point format {}, {} bytes a point unpacked, items of version {}",
                                     info.source.version, header.point_format, header.record_length, format.version);
  info.source.version = "1.0";
  info.cube = {copc.center - copc.half_edge, 2.0 * copc.half_edge};
  info.spacing = std::isfinite(copc.spacing) && copc.spacing > 0.0 ? copc.spacing : 0.0;
  info.cell_margin = kCellMargin * header.grid.scale;
  const WorldBox& box = info.source.stated_bounds;
  if (!box.empty()) {
    info.position_range.min = {box.min.x, box.min.y, box.min.z};
    info.position_range.max = {box.max.x, box.max.y, box.max.z};
  }
  info.ranges.resize(info.source.schema.size());
  if (const auto time = find_attribute(info.source.schema, "gps-time"); time && copc.gps_time_min < copc.gps_time_max)
    info.ranges[*time] = range_of(copc.gps_time_min, copc.gps_time_max);
  return info;
}

}  // namespace

CopcStore::CopcStore(const std::string& path)
    : file_(path), header_(load_header(file_)), format_(laz::read_format(file_.map().bytes(), header_, path)) {
  const copc::Info copc = load_info(file_, header_);
  info_ = describe(header_, format_, copc, path);
  count_read(header_.points_begin);
  if (header_.point_count > 0) root_piece_ = read_page(copc.root_page, copc.root_page_bytes, StoredNode{});
}

TreeStore::HierarchyPiece CopcStore::read_piece(const HierarchyPiece::Continuation& where,
                                                const StoredNode& parent) const {
  return read_page(where.piece, where.piece_size, parent);
}

TreeStore::HierarchyPiece CopcStore::read_page(std::uint64_t offset, std::uint64_t bytes,
                                               const StoredNode& first) const {
  if (offset > file_.size() || bytes > file_.size() - offset)
    throw file_error(file_.path(), std::min(offset, file_.size()),
                     fmt::format("a hierarchy page was expected in bytes {} + {}, and the file has {}. It was cut off "
                                 "or damaged; copy it again.",
                                 offset, bytes, file_.size()));
  Buffer<std::byte> page(static_cast<std::size_t>(bytes));
  file_.read_at(offset, page);
  count_read(bytes);
  return copc::parse_page({page, offset, file_.size(), file_.path()}, first);
}

void CopcStore::read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const {
  if (node.points == 0) return clear_batch(info_.source.schema, attributes, batch);
  std::vector<las::Field> fields;
  for (const std::size_t index : attributes) fields.push_back(header_.fields.at(index));
  laz::ChunkReader reader(file_, format_, std::move(fields));
  try {
    reader.read_chunk({node.byte_offset, node.byte_size, 0, node.points, 0}, batch);
  } catch (const Error& error) {
    throw Error(fmt::format("{} It holds node {}.", error.what(), name_of(node)));
  }
  count_read(node.byte_size);
}

bool is_copc(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const InputFile file(path);
  // The record's header: u16 reserved, char[16] user id, u16 record id
  std::array<std::byte, copc::kInfoRecordAt + las::kVlrHeaderSize> start{};
  if (file.size() < start.size()) return false;
  file.read_at(0, start);
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  const std::string_view user_id = text.substr(copc::kInfoRecordAt + las::kRecordUserId, las::kRecordUserIdSize);
  const unsigned record_id = std::to_integer<unsigned>(start[copc::kInfoRecordAt + las::kRecordId]) |
                             std::to_integer<unsigned>(start[copc::kInfoRecordAt + las::kRecordId + 1]) << 8;
  return text.starts_with("LASF") && user_id.substr(0, user_id.find('\0')) == copc::kUserId &&
         record_id == copc::kInfoRecord;
}

}  // namespace stipple
