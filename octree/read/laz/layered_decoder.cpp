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

// One stream of a chunk.
struct Layer {
  std::string name;            // for messages
  std::size_t first_byte = 0;  // of a record, that the layer fills
  std::size_t bytes = 0;
  bool wanted = false;

  // Of the current chunk
  std::uint64_t file_offset = 0;
  std::uint32_t size = 0;  // bytes; 0: all points have the value of the first
  std::size_t begin = 0;   // in the buffer
  ArithmeticDecoder decoder{};

  bool active() const { return wanted && size > 0; }
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
  LayeredDecoder(const InputFile& file, const Format& format, std::span<const las::Field> fields)
      : file_(file), format_(format), layers_(layers_of(format)), first_(format.record_length) {
    layers_[kReturnsXy].wanted = layers_[kZ].wanted = true;
    for (const las::Field& field : fields)
      for (Layer& layer : layers_)
        layer.wanted |=
            field.offset < layer.first_byte + layer.bytes && layer.first_byte < field.offset + field.attribute.bytes();
    for (std::size_t i = kPointLayers; i < layers_.size(); ++i)
      if (format.find(ItemType::bytes14) && layers_[i].first_byte >= format.find(ItemType::bytes14)->offset) {
        extra_ = i;
        break;
      }
    if (extra_ != 0) bytes_.resize(layers_.size() - extra_);
  }

  void begin(const Chunk& chunk) override;
  void decode(std::span<std::byte> records) override;
  std::uint64_t end() override { return chunk_end_; }

 private:
  void read_sizes();
  void read_layers();
  void begin_layers();
  void decode_block(std::byte* out, std::size_t count);

  // Calls decode(ArithmeticDecoder&, i) for each of `count` points.
  template <class Decode>
  void run(Layer& layer, std::size_t count, Decode&& decode) {
    ArithmeticDecoder decoder = layer.decoder;
    const std::byte* const end = buffer_.data() + layer.begin + layer.size;
    for (std::size_t i = 0; i < count; ++i) {
      decode(decoder, i);
      if (decoder.at > end || decoder.broken != 0) [[unlikely]]
        fail(layer, decoder, done_ + i);
    }
    layer.decoder = decoder;
  }

  // A layer of one value of POINT14.
  template <class Decoder>
  void run_value(Layer& layer, Decoder& values, std::byte* out, std::size_t count) {
    if (!layer.active()) return;
    using Value = typename Decoder::Value;
    out += Decoder::kOffset;
    // Of the point before: the record before, or the end of the block before
    Value before = load<Value>(last_.data() + Decoder::kOffset);
    run(layer, count, [&](ArithmeticDecoder& decoder, std::size_t i) {
      before = values.decode(decoder, contexts_[i], before);
      store(out + i * format_.record_length, before);
    });
  }

  // A layer of another item.
  template <class Models>
  void run_item(Layer& layer, ItemLayer<Models>& values, std::byte* out, std::size_t count) {
    if (!layer.active()) return;
    out += layer.first_byte;
    run(layer, count, [&](ArithmeticDecoder& decoder, std::size_t i) {
      store(out + i * format_.record_length, values.decode(decoder, contexts_[i]));
    });
  }

  [[noreturn, gnu::noinline]] void fail(const Layer& layer, const ArithmeticDecoder& decoder,
                                        std::uint64_t point) const;

  Layer* find(std::string_view name) {
    const auto found = std::ranges::find(layers_, name, &Layer::name);
    return found == layers_.end() ? nullptr : &*found;
  }

  // Points of a block: their records and contexts stay in the nearest cache from layer to layer.
  static constexpr std::size_t kBlock = 1024;

  const InputFile& file_;
  const Format format_;
  std::vector<Layer> layers_;
  std::size_t extra_ = 0;  // the first layer of extra bytes; 0: none
  Chunk chunk_;
  std::uint64_t chunk_end_ = 0;
  std::uint64_t done_ = 0;
  Buffer<std::byte> head_;    // sizes of the layers
  Buffer<std::byte> buffer_;  // the layers that are wanted
  Buffer<std::byte> first_;   // the first record
  Buffer<std::byte> last_;    // the last record decoded
  std::array<PointContext, kBlock> contexts_;

  ReturnsXyLayer returns_xy_;
  ZLayer z_;
  ClassificationLayer classification_;
  FlagsLayer flags_;
  IntensityLayer intensity_;
  ScanAngleLayer scan_angle_;
  UserDataLayer user_data_;
  PointSourceLayer point_source_;
  GpsTimeLayer gps_time_;
  ItemLayer<RgbModels> rgb_;
  ItemLayer<NirModels> nir_;
  ItemLayer<WaveModels> wave_;
  std::vector<ItemLayer<ByteModels>> bytes_;
};

void LayeredDecoder::begin(const Chunk& chunk) {
  chunk_ = chunk;
  done_ = 0;
  head_.resize(format_.record_length + sizeof(std::uint32_t) * (1 + layers_.size()));
  if (chunk.bytes < head_.size())
    throw chunk_error(file_.path(), chunk.begin, chunk,
                      fmt::format("has {} bytes, and {} or more were expected.", chunk.bytes, head_.size()));
  file_.read_at(chunk.begin, head_);
  std::memcpy(first_.data(), head_.data(), first_.size());
  last_ = first_;
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
  for (Layer& layer : layers_) {
    at += sizeof(std::uint32_t);
    layer.size = load<std::uint32_t>(at);
    layer.file_offset = offset;
    offset += layer.size;
    if (offset - chunk_.begin > chunk_.bytes)
      throw chunk_error(file_.path(), layer.file_offset, chunk_,
                        fmt::format("has {} bytes, and its layer \"{}\" of {} bytes reaches beyond them.", chunk_.bytes,
                                    layer.name, layer.size));
    if (layer.size > 0 && layer.size < ArithmeticDecoder::kStartBytes)
      throw chunk_error(file_.path(), layer.file_offset, chunk_,
                        fmt::format("has a layer \"{}\" of {} bytes; none, or {} and more, were expected.", layer.name,
                                    layer.size, ArithmeticDecoder::kStartBytes));
  }
  chunk_end_ = offset;
}

void LayeredDecoder::read_layers() {
  std::size_t room = 0;
  for (Layer& layer : layers_)
    if (layer.active()) {
      layer.begin = room;
      room += layer.size + kPadding;
    }
  buffer_.resize(room);
  for (Layer& layer : layers_) {
    if (!layer.active()) continue;
    const std::span<std::byte> bytes = std::span(buffer_).subspan(layer.begin, layer.size + kPadding);
    file_.read_at(layer.file_offset, bytes.first(layer.size));
    std::ranges::fill(bytes.subspan(layer.size), std::byte{0});
    layer.decoder.start(bytes.data());
  }
}

void LayeredDecoder::begin_layers() {
  const std::byte* const first = first_.data();
  returns_xy_.begin(first);
  const unsigned channel = load<std::uint8_t>(first + 15) >> 4 & 3u;
  const auto begin_value = [&]<class Values>(Values& values, const Layer& layer) {
    if (layer.active()) values.begin(channel, load<typename Values::Value>(first + Values::kOffset));
  };
  begin_value(z_, layers_[kZ]);
  begin_value(classification_, layers_[kClassification]);
  begin_value(flags_, layers_[kFlags]);
  begin_value(intensity_, layers_[kIntensity]);
  begin_value(scan_angle_, layers_[kScanAngle]);
  begin_value(user_data_, layers_[kUserData]);
  begin_value(point_source_, layers_[kPointSource]);
  begin_value(gps_time_, layers_[kGpsTime]);
  const bool corrected = format_.version >= 4;
  const auto begin_item = [&]<class Models>(ItemLayer<Models>& item, const Layer& layer) {
    if (layer.active()) item.begin(channel, load<typename Models::Value>(first + layer.first_byte), corrected);
  };
  if (const Layer* layer = find("rgb")) begin_item(rgb_, *layer);
  if (const Layer* layer = find("nir")) begin_item(nir_, *layer);
  if (const Layer* layer = find("waveform packet")) begin_item(wave_, *layer);
  for (std::size_t i = 0; i < bytes_.size(); ++i) begin_item(bytes_[i], layers_[extra_ + i]);
}

void LayeredDecoder::decode(std::span<std::byte> records) {
  std::size_t count = records.size() / format_.record_length;
  std::byte* out = records.data();
  if (done_ == 0 && count > 0) {
    std::memcpy(out, first_.data(), first_.size());
    out += format_.record_length;
    --count;
    done_ = 1;
  }
  while (count > 0) {
    const std::size_t block = std::min(count, kBlock);
    decode_block(out, block);
    out += block * format_.record_length;
    count -= block;
  }
}

void LayeredDecoder::decode_block(std::byte* out, std::size_t count) {
  // What is in no layer is as in the first point
  for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * format_.record_length, first_.data(), first_.size());
  Layer& returns_xy = layers_[kReturnsXy];
  if (returns_xy.size == 0)
    throw chunk_error(file_.path(), returns_xy.file_offset, chunk_, "has no layer \"x, y and returns\".");
  run(returns_xy, count, [&](ArithmeticDecoder& decoder, std::size_t i) {
    contexts_[i] = returns_xy_.decode(decoder, out + i * format_.record_length);
  });
  run_value(layers_[kZ], z_, out, count);
  run_value(layers_[kClassification], classification_, out, count);
  run_value(layers_[kFlags], flags_, out, count);
  run_value(layers_[kIntensity], intensity_, out, count);
  run_value(layers_[kScanAngle], scan_angle_, out, count);
  run_value(layers_[kUserData], user_data_, out, count);
  run_value(layers_[kPointSource], point_source_, out, count);
  run_value(layers_[kGpsTime], gps_time_, out, count);
  if (Layer* layer = find("rgb")) run_item(*layer, rgb_, out, count);
  if (Layer* layer = find("nir")) run_item(*layer, nir_, out, count);
  if (Layer* layer = find("waveform packet")) run_item(*layer, wave_, out, count);
  for (std::size_t i = 0; i < bytes_.size(); ++i) run_item(layers_[extra_ + i], bytes_[i], out, count);
  std::memcpy(last_.data(), out + (count - 1) * format_.record_length, format_.record_length);
  done_ += count;
}

void LayeredDecoder::fail(const Layer& layer, const ArithmeticDecoder& decoder, std::uint64_t point) const {
  const auto used = static_cast<std::uint64_t>(decoder.at - (buffer_.data() + layer.begin));
  const std::uint64_t place = layer.file_offset + std::min<std::uint64_t>(used, layer.size);
  if (decoder.broken != 0)
    throw chunk_error(file_.path(), place, chunk_,
                      fmt::format("is damaged: what layer \"{}\" holds for point {} is nothing that an encoder writes.",
                                  layer.name, point));
  throw chunk_error(file_.path(), place, chunk_, fmt::format("ends its layer \"{}\" in point {}.", layer.name, point));
}

}  // namespace

std::unique_ptr<PointDecoder> make_layered_decoder(const InputFile& file, const Format& format,
                                                   std::span<const las::Field> fields) {
  return std::make_unique<LayeredDecoder>(file, format, fields);
}

}  // namespace stipple::laz
