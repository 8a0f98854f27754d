#include "octree/read/laz/laz_format.h"

#include <algorithm>
#include <array>

#include "octree/read/las/las_bytes.h"

namespace stipple::laz {
namespace {

// Body of the record: byte offsets. Source: LASzip specification, "laszip VLR".
constexpr std::size_t kCompressorAt = 0;  // u16
constexpr std::size_t kCoderAt = 2;       // u16, 0: arithmetic
constexpr std::size_t kChunkSizeAt = 12;  // u32
constexpr std::size_t kItemCountAt = 32;  // u16
constexpr std::size_t kItemsAt = 34;      // u16 type, u16 size, u16 version
constexpr std::size_t kItemBytes = 6;

constexpr std::uint16_t kArithmeticCoder = 0;
constexpr std::string_view kRemedy = "It is damaged, or newer than what is read; write it anew with LASzip.";

unsigned number_of(ItemType type) {
  return static_cast<unsigned>(type);
}

struct Expected {
  ItemType type;
  std::size_t size;
};

// The items of a point format; the rest of the record are extra bytes.
std::vector<Expected> items_of(int point_format) {
  using enum ItemType;
  constexpr Expected kPoint10{point10, 20}, kTime{gps_time11, 8}, kRgb{rgb12, 6}, kWave{wave_packet13, 29};
  constexpr Expected kPoint14{point14, 30}, kRgb14{rgb14, 6}, kNir14{rgb_nir14, 8}, kWave14{wave_packet14, 29};
  switch (point_format) {
    case 0:
      return {kPoint10};
    case 1:
      return {kPoint10, kTime};
    case 2:
      return {kPoint10, kRgb};
    case 3:
      return {kPoint10, kTime, kRgb};
    case 4:
      return {kPoint10, kTime, kWave};
    case 5:
      return {kPoint10, kTime, kRgb, kWave};
    case 6:
      return {kPoint14};
    case 7:
      return {kPoint14, kRgb14};
    case 8:
      return {kPoint14, kNir14};
    case 9:
      return {kPoint14, kWave14};
    default:
      return {kPoint14, kNir14, kWave14};
  }
}

// Version 2 of layered items is version 3 by another name, from before it had one. Waveform packets of version 1 are
// those of version 2, too.
int common_version(ItemType type, int version) {
  if (type >= ItemType::point14) return version == 2 ? 3 : version;
  return version;
}

bool is_read(ItemType type, int version) {
  if (type >= ItemType::point14) return version >= 2 && version <= 4;
  if (type == ItemType::wave_packet13) return version == 1;
  return version == 1 || version == 2;
}

class Parser {
 public:
  Parser(std::span<const std::byte> body, std::uint64_t offset, const las::Header& header, std::string_view path)
      : body_(body), offset_(offset), header_(header), path_(path) {}

  Format parse() {
    if (body_.size() < kItemsAt)
      throw error(0, fmt::format("it has {} bytes, and {} or more were expected.", body_.size(), kItemsAt));
    if (word(kCoderAt) != kArithmeticCoder)
      throw error(kCoderAt, fmt::format("coder {} was found, and {} is read.", word(kCoderAt), kArithmeticCoder));
    Format format;
    format.record_length = header_.record_length;
    const bool layered = header_.point_format >= 6;
    const unsigned compressor = word(kCompressorAt);
    if (layered ? compressor != 3 : compressor != 1 && compressor != 2)
      throw error(kCompressorAt, fmt::format("compressor {} was found, and {} was expected with point format {}.",
                                             compressor, layered ? "3" : "1 or 2", header_.point_format));
    format.compressor = static_cast<Compressor>(compressor);
    std::memcpy(&format.chunk_size, body_.data() + kChunkSizeAt, sizeof format.chunk_size);
    if (format.compressor != Compressor::pointwise && format.chunk_size == 0) format.chunk_size = kVariableChunks;
    parse_items(format);
    return format;
  }

 private:
  void parse_items(Format& format) {
    const std::vector<Expected> expected = items_of(header_.point_format);
    const std::size_t count = word(kItemCountAt);
    if (count > (body_.size() - kItemsAt) / kItemBytes || count < expected.size())
      throw error(kItemCountAt,
                  fmt::format("it states {} items and has room for {}; point format {} has {} or more.", count,
                              (body_.size() - kItemsAt) / kItemBytes, header_.point_format, expected.size()));
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = kItemsAt + i * kItemBytes;
      const Item item{static_cast<ItemType>(word(at)), word(at + 2), end};
      check_item(item, i < expected.size() ? &expected[i] : nullptr, at);
      take_version(format, item.type, at);
      format.items.push_back(item);
      end += item.size;
    }
    if (end != header_.record_length)
      throw error(kItemsAt, fmt::format("its items have {} bytes, and {} bytes a point are stated by the header.", end,
                                        header_.record_length));
  }

  void check_item(const Item& item, const Expected* expected, std::size_t at) const {
    const ItemType extra = header_.point_format >= 6 ? ItemType::bytes14 : ItemType::bytes;
    if (expected ? item.type == expected->type && item.size == expected->size : item.type == extra && item.size > 0)
      return;
    const std::string wanted = expected ? fmt::format("item {} of {} bytes", number_of(expected->type), expected->size)
                                        : fmt::format("extra bytes (item {})", number_of(extra));
    throw error(at, fmt::format("item {} of {} bytes was found, and {} was expected with point format {}.",
                                number_of(item.type), item.size, wanted, header_.point_format));
  }

  void take_version(Format& format, ItemType type, std::size_t at) const {
    const int version = word(at + 4);
    if (!is_read(type, version))
      throw error(at + 4, fmt::format("version {} of item {} was found, which is none that is read.", version,
                                      number_of(type)));
    if (type == ItemType::wave_packet13) return;
    const int common = common_version(type, version);
    if (format.version != 0 && format.version != common)
      throw error(at + 4, fmt::format("version {} of item {} was found, and version {}, as of the items before it, was "
                                      "expected.",
                                      version, number_of(type), format.version));
    format.version = common;
  }

  std::uint16_t word(std::size_t at) const {
    std::uint16_t value;
    std::memcpy(&value, body_.data() + at, sizeof value);
    return value;
  }

  Error error(std::size_t at, std::string_view what) const {
    return file_error(
        path_, offset_ + at,
        fmt::format("in the record \"{}\", which describes the compression, {} {}", kUserId, what, kRemedy));
  }

  std::span<const std::byte> body_;
  std::uint64_t offset_;
  const las::Header& header_;
  std::string_view path_;
};

}  // namespace

const Item* Format::find(ItemType type) const {
  const auto found = std::ranges::find(items, type, &Item::type);
  return found == items.end() ? nullptr : &*found;
}

Format parse_format(std::span<const std::byte> body, std::uint64_t offset, const las::Header& header,
                    std::string_view path) {
  return Parser(body, offset, header, path).parse();
}

Format read_format(std::span<const std::byte> file, const las::Header& header, std::string_view path) {
  const las::Record* const record = las::find_record(header.records, kUserId, kRecordId);
  if (!record)
    throw file_error(path, las::kPointFormat,
                     fmt::format("the points are LAZ-compressed (bit 7 of the point format is set), and the record "
                                 "\"{}\", which says how, was expected and is not there. The file is damaged; write it "
                                 "anew from its source.",
                                 kUserId));
  return parse_format(file.subspan(record->begin, record->size), record->begin, header, path);
}

}  // namespace stipple::laz
