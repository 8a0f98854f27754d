#include "octree/read/laz/layered_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "octree/read/laz/layered_items.h"

namespace stipple::laz {
namespace {

// Layers stand in the order of the items, and those of the first item in this one.
enum PointLayer : std::size_t {
  kReturnsXy,
  kZ,
  kClassification,
  kFlags,
  kIntensity,
  kScanAngle,
  kUserData,
  kPointSource,
  kGpsTime,
  kPointLayers
};

// Behind a layer in memory: a point takes no more of it than this.
constexpr std::size_t kPadding = 128;

// Where the values of one stream go.
struct Layer {
  std::string name;            // for messages
  std::size_t first_byte = 0;  // of a record, that the layer fills
  std::size_t bytes = 0;
};

// The stream of a layer in the current chunk.
struct Stream {
  bool wanted = false;
  bool active = false;  // wanted and not empty; the points of an empty one have the value of the first
  ArithmeticDecoder decoder;
  const std::byte* end = nullptr;
  std::uint64_t file_offset = 0;
  std::uint32_t size = 0;  // bytes
};

std::vector<Layer> layers_of(const Format& format) {
  std::vector<Layer> layers{
      {"x, y and returns", 0, 12}, {"z", 8, 4},           {"classification", 16, 1}, {"flags", 15, 1},
      {"intensity", 12, 2},        {"scan angle", 18, 2}, {"user data", 17, 1},      {"point source id", 20, 2},
      {"gps-time", 22, 8}};
  for (const Item& item : format.items) {
    if (item.type == ItemType::rgb14) layers.push_back({"rgb", item.offset, 6});
    if (item.type == ItemType::rgb_nir14) {
      layers.push_back({"rgb", item.offset, 6});
      layers.push_back({"nir", item.offset + 6, 2});
    }
    if (item.type == ItemType::wave_packet14) layers.push_back({"waveform packet", item.offset, item.size});
    if (item.type == ItemType::bytes14)
      for (std::size_t i = 0; i < item.size; ++i)
        layers.push_back({fmt::format("extra byte {}", i), item.offset + i, 1});
  }
  return layers;
}

class LayeredDecoder final : public PointDecoder {
 public:
  LayeredDecoder(const InputFile& file, const Format& format, std::span<const las::Field> fields);

  void begin(const Chunk& chunk) override;
  void decode(std::span<std::byte> records) override;
  // Its streams already are worked on side by side.
  void decode_both(std::span<std::byte> records, PointDecoder& other, std::span<std::byte> other_records) override {
    decode(records);
    other.decode(other_records);
  }
  std::uint64_t end() override { return chunk_end_; }

 private:
  void read_sizes();
  void read_layers();
  void begin_layers();
  void decode_points(std::byte* out, std::size_t count);
  bool decode_items(const PointContext& context, std::byte* out);

  // The next value of a layer of POINT14. `before`: the record of the point before. Returns whether that failed.
  template <class Values>
  [[gnu::always_inline]] bool decode_value(PointLayer layer, Values& values, const PointContext& context,
                                           const std::byte* before, std::byte* out) {
    Stream& stream = streams_[layer];
    if (!stream.active) return false;
    const auto last = load<typename Values::Value>(before + Values::kOffset);
    store(out + Values::kOffset, values.decode(stream.decoder, context, last));
    return failed(stream);
  }

  // The next value of a layer of another item.
  template <class Models>
  [[gnu::always_inline]] bool decode_item(std::size_t layer, ItemLayer<Models>& values, const PointContext& context,
                                          std::byte* out) {
    Stream& stream = streams_[layer];
    if (!stream.active) return false;
    store_item(out + layers_[layer].first_byte, values.decode(stream.decoder, context));
    return failed(stream);
  }

  static bool failed(const Stream& stream) { return (stream.decoder.at > stream.end) | (stream.decoder.broken != 0); }
  [[noreturn, gnu::noinline]] void report_failure(std::uint64_t point) const;

  // The layer of that name; the number of layers, which is no layer, when there is none.
  std::size_t find(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(layers_, name, &Layer::name) - layers_.begin());
  }

  const InputFile& file_;
  const Format format_;
  const std::vector<Layer> layers_;
  const std::size_t rgb_;
  const std::size_t nir_;
  const std::size_t wave_;
  std::size_t extra_;  // the first layer of extra bytes

  Chunk chunk_;
  std::uint64_t chunk_end_ = 0;
  std::uint64_t done_ = 0;       // points of the chunk
  std::vector<Stream> streams_;  // one a layer
  bool has_items_ = false;       // active streams beside those of POINT14
  Buffer<std::byte> head_;       // first record and sizes of the layers
  Buffer<std::byte> buffer_;     // the streams that are wanted
  std::vector<std::byte> last_;  // the last record of what was decoded before

  ReturnsXyLayer returns_xy_layer_;
  ZLayer z_layer_;
  ClassificationLayer classification_layer_;
  FlagsLayer flags_layer_;
  IntensityLayer intensity_layer_;
  ScanAngleLayer scan_angle_layer_;
  UserDataLayer user_data_layer_;
  PointSourceLayer point_source_layer_;
  GpsTimeLayer gps_time_layer_;
  ItemLayer<RgbModels> rgb_layer_;
  ItemLayer<NirModels> nir_layer_;
  ItemLayer<WaveModels> wave_layer_;
  std::vector<ItemLayer<ByteModels>> byte_layers_;
};

LayeredDecoder::LayeredDecoder(const InputFile& file, const Format& format, std::span<const las::Field> fields)
    : file_(file),
      format_(format),
      layers_(layers_of(format)),
      rgb_(find("rgb")),
      nir_(find("nir")),
      wave_(find("waveform packet")),
      extra_(find("extra byte 0")),
      streams_(layers_.size() + 1),
      head_(format.record_length + sizeof(std::uint32_t) * (1 + layers_.size())),
      last_(format.record_length),
      byte_layers_(layers_.size() - extra_) {
  streams_[kReturnsXy].wanted = streams_[kZ].wanted = true;
  for (const las::Field& field : fields)
    for (std::size_t i = 0; i < layers_.size(); ++i)
      streams_[i].wanted |= field.offset < layers_[i].first_byte + layers_[i].bytes &&
                            layers_[i].first_byte < field.offset + field.attribute.bytes();
}

void LayeredDecoder::begin(const Chunk& chunk) {
  chunk_ = chunk;
  done_ = 0;
  if (chunk.bytes < head_.size())
    throw chunk_error(file_.path(), chunk.begin, chunk,
                      fmt::format("has {} bytes, and {} or more were expected.", chunk.bytes, head_.size()));
  file_.read_at(chunk.begin, head_);
  read_sizes();
  read_layers();
  begin_layers();
}

void LayeredDecoder::read_sizes() {
  const std::byte* at = head_.data() + format_.record_length;
  const auto points = load<std::uint32_t>(at);
  if (points != chunk_.points)
    throw chunk_error(file_.path(), chunk_.begin + format_.record_length, chunk_,
                      fmt::format("states {} points itself.", points));
  std::uint64_t offset = chunk_.begin + head_.size();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    at += sizeof(std::uint32_t);
    Stream& stream = streams_[i];
    stream.size = load<std::uint32_t>(at);
    stream.file_offset = offset;
    stream.active = stream.wanted && stream.size > 0;
    offset += stream.size;
    if (offset - chunk_.begin > chunk_.bytes)
      throw chunk_error(file_.path(), stream.file_offset, chunk_,
                        fmt::format("has {} bytes, and its layer \"{}\" of {} bytes reaches beyond them.", chunk_.bytes,
                                    layers_[i].name, stream.size));
    if (stream.size > 0 && stream.size < ArithmeticDecoder::kStartBytes)
      throw chunk_error(file_.path(), stream.file_offset, chunk_,
                        fmt::format("has a layer \"{}\" of {} bytes; none, or {} and more, were expected.",
                                    layers_[i].name, stream.size, ArithmeticDecoder::kStartBytes));
  }
  chunk_end_ = offset;
  if (chunk_.points > 1 && streams_[kReturnsXy].size == 0)
    throw chunk_error(file_.path(), streams_[kReturnsXy].file_offset, chunk_,
                      fmt::format("has no layer \"{}\".", layers_[kReturnsXy].name));
}

void LayeredDecoder::read_layers() {
  std::size_t room = 0;
  for (const Stream& stream : streams_)
    if (stream.active) room += stream.size + kPadding;
  buffer_.resize(room);
  std::byte* at = buffer_.data();
  for (Stream& stream : streams_) {
    if (!stream.active) continue;
    file_.read_at(stream.file_offset, {at, stream.size});
    stream.end = at + stream.size;
    std::memset(at + stream.size, 0, kPadding);
    stream.decoder.start(at);
    at += stream.size + kPadding;
  }
}

void LayeredDecoder::begin_layers() {
  const std::byte* const first = head_.data();
  const unsigned channel = load<std::uint8_t>(first + 15) >> 4 & 3u;
  const auto begin_value = [&]<class Values>(Values& values, PointLayer layer) {
    if (streams_[layer].active) values.begin(channel, load<typename Values::Value>(first + Values::kOffset));
  };
  returns_xy_layer_.begin(first);
  begin_value(z_layer_, kZ);
  begin_value(classification_layer_, kClassification);
  begin_value(flags_layer_, kFlags);
  begin_value(intensity_layer_, kIntensity);
  begin_value(scan_angle_layer_, kScanAngle);
  begin_value(user_data_layer_, kUserData);
  begin_value(point_source_layer_, kPointSource);
  begin_value(gps_time_layer_, kGpsTime);
  has_items_ = false;
  const bool corrected = format_.version >= 4;
  const auto begin_item = [&]<class Models>(ItemLayer<Models>& item, std::size_t layer) {
    if (!streams_[layer].active) return;
    has_items_ = true;
    item.begin(channel, load_item<typename Models::Value>(first + layers_[layer].first_byte), corrected);
  };
  begin_item(rgb_layer_, rgb_);
  begin_item(nir_layer_, nir_);
  begin_item(wave_layer_, wave_);
  for (std::size_t i = 0; i < byte_layers_.size(); ++i) begin_item(byte_layers_[i], extra_ + i);
}

void LayeredDecoder::decode(std::span<std::byte> records) {
  const std::size_t length = format_.record_length;
  std::size_t count = records.size() / length;
  if (count == 0) return;
  std::byte* out = records.data();
  if (done_ == 0) {
    std::memcpy(out, head_.data(), length);
    std::memcpy(last_.data(), out, length);
    out += length;
    --count;
    done_ = 1;
  }
  decode_points(out, count);
  std::memcpy(last_.data(), records.data() + records.size() - length, length);
}

// All layers of a point before the next point: streams do not wait for one another, so that a processor works on
// several at once. Layer after layer took half as long again.
void LayeredDecoder::decode_points(std::byte* out, std::size_t count) {
  const std::size_t length = format_.record_length;
  const std::byte* const first = head_.data();
  const std::byte* before = last_.data();
  for (std::size_t i = 0; i < count; ++i, before = out, out += length) {
    // What is in no layer is as in the first point
    std::memcpy(out, first, length);
    const PointContext context = returns_xy_layer_.decode(streams_[kReturnsXy].decoder, out);
    bool failure = failed(streams_[kReturnsXy]);
    failure |= decode_value(kZ, z_layer_, context, before, out);
    failure |= decode_value(kClassification, classification_layer_, context, before, out);
    failure |= decode_value(kFlags, flags_layer_, context, before, out);
    failure |= decode_value(kIntensity, intensity_layer_, context, before, out);
    failure |= decode_value(kScanAngle, scan_angle_layer_, context, before, out);
    failure |= decode_value(kUserData, user_data_layer_, context, before, out);
    failure |= decode_value(kPointSource, point_source_layer_, context, before, out);
    failure |= decode_value(kGpsTime, gps_time_layer_, context, before, out);
    if (has_items_) failure |= decode_items(context, out);
    if (failure) [[unlikely]]
      report_failure(done_ + i);
  }
  done_ += count;
}

[[gnu::always_inline]] inline bool LayeredDecoder::decode_items(const PointContext& context, std::byte* out) {
  bool failure = decode_item(rgb_, rgb_layer_, context, out);
  failure |= decode_item(nir_, nir_layer_, context, out);
  failure |= decode_item(wave_, wave_layer_, context, out);
  for (std::size_t i = 0; i < byte_layers_.size(); ++i)
    failure |= decode_item(extra_ + i, byte_layers_[i], context, out);
  return failure;
}

void LayeredDecoder::report_failure(std::uint64_t point) const {
  const auto found = std::ranges::find_if(streams_, [](const Stream& s) { return s.active && failed(s); });
  const std::string& name = layers_[static_cast<std::size_t>(found - streams_.begin())].name;
  const bool ended = found->decoder.at > found->end;
  const std::uint64_t left = ended ? 0 : static_cast<std::uint64_t>(found->end - found->decoder.at);
  const std::string what =
      ended ? fmt::format("ends its layer \"{}\" in point {}.", name, point)
            : fmt::format("is damaged: what layer \"{}\" holds for point {} is nothing that an encoder writes.", name,
                          point);
  throw chunk_error(file_.path(), found->file_offset + found->size - left, chunk_, what);
}

}  // namespace

std::unique_ptr<PointDecoder> make_layered_decoder(const InputFile& file, const Format& format,
                                                   std::span<const las::Field> fields) {
  return std::make_unique<LayeredDecoder>(file, format, fields);
}

}  // namespace stipple::laz
