// Whole LAZ files made for tests: point formats 0 to 3 in chunks, 6 and 7 in layers, all with extra bytes.
#pragma once

#include <memory>

#include "tests/read/laz_item_encoders.h"

namespace stipple::test {

// What a chunk of format 0 to 3 is behind its first point.
inline Bytes encode_pointwise(int format, std::size_t length, const std::byte* records, std::size_t count) {
  const std::size_t time = 20, rgb = time + (format & 1 ? 8 : 0), extra = rgb + (format & 2 ? 6 : 0);
  const auto time_of = [&](const std::byte* record) {
    std::uint64_t value;
    std::memcpy(&value, record + time, sizeof value);
    return value;
  };
  ArithmeticEncoder out;
  Point10Encoder points(records);
  GpsTimeEncoder times(format & 1 ? time_of(records) : 0, 1);
  RgbEncoder colours(records + (format & 2 ? rgb : 0));
  std::vector<ExtraByteEncoder> bytes;
  for (std::size_t b = extra; b < length; ++b) bytes.emplace_back(records[b]);
  for (std::size_t i = 1; i < count; ++i) {
    const std::byte* const record = records + i * length;
    points.encode(out, record);
    if (format & 1) times.encode(out, time_of(record));
    if (format & 2) colours.encode(out, record + rgb);
    for (std::size_t b = extra; b < length; ++b) bytes[b - extra].encode(out, record[b]);
  }
  return out.finish();
}

// A record of POINT14.
struct LayeredFields {
  std::int32_t x, y, z;
  std::uint16_t intensity;
  std::uint8_t returns, flags, classification, user_data;
  std::int16_t angle;
  std::uint16_t source;
  std::uint64_t time = 0;

  explicit LayeredFields(const std::byte* record) {
    std::memcpy(this, record, 22);
    std::memcpy(&time, record + 22, sizeof time);
  }
  unsigned number() const { return returns & 15u; }
  unsigned count() const { return returns >> 4; }
  unsigned channel() const { return flags >> 4 & 3u; }
  unsigned six_flags() const { return (flags & 15u) | (flags >> 2 & 48u); }
};

// The layers of points with POINT14, colours and extra bytes. Each channel has models of its own, as in version 4; with
// one channel that is version 3, too.
class LayerEncoder {
 public:
  LayerEncoder(bool has_rgb, std::size_t length, const std::byte* first)
      : rgb_(has_rgb ? 30 : 0),
        extra_(has_rgb ? 36 : 30),
        length_(length),
        layers_(extra_bytes() + (has_rgb ? 10 : 9)) {
    channel_ = LayeredFields(first).channel();
    channels_[channel_] = std::make_unique<Channel>(*this, first);
    before_ = first;
  }

  void encode(const std::byte* record) {
    const LayeredFields p(record);
    const Context context = encode_xy(p);
    Channel& c = *channels_[channel_];
    const LayeredFields& last = c.last;
    c.z.encode(layers_[1], c.heights[context.level], p.z, context.z);
    c.heights[context.level] = p.z;
    layers_[2].symbol(c.classes[(last.classification & 31u) * 2 + (context.returns == 3)], p.classification);
    layers_[3].symbol(c.flags[last.six_flags()], p.six_flags());
    std::uint16_t& intensity = c.intensities[context.returns * 2 + c.time_changed];
    c.intensity.encode(layers_[4], intensity, p.intensity, context.returns);
    intensity = p.intensity;
    if (p.angle != last.angle) c.angle.encode(layers_[5], last.angle, p.angle, c.time_changed);
    layers_[6].symbol(c.user_data[last.user_data / 4u], p.user_data);
    if (p.source != last.source) c.source.encode(layers_[7], last.source, p.source);
    if (c.time_changed) c.times.encode(layers_[8], p.time);
    if (rgb_ != 0) c.colours.encode(layers_[9], record + rgb_);
    for (std::size_t b = 0; b < extra_bytes(); ++b)
      c.bytes[b].encode(layers_[layers_.size() - extra_bytes() + b], record[extra_ + b]);
    c.last = p;
    before_ = record;
  }

  std::vector<Bytes> finish() {
    std::vector<Bytes> streams;
    for (ArithmeticEncoder& layer : layers_) streams.push_back(layer.finish());
    return streams;
  }

 private:
  struct Channel {
    Channel(const LayerEncoder& of, const std::byte* before)
        : last(before), times(last.time, 0), colours(before + of.rgb_) {
      heights.fill(last.z);
      intensities.fill(last.intensity);
      for (std::size_t b = 0; b < of.extra_bytes(); ++b) bytes.emplace_back(before[of.extra_ + b]);
    }
    LayeredFields last;
    bool time_changed = false;
    SymbolTables changed{128}, counts{16}, numbers{16}, classes{256}, flags{64}, user_data{256};
    SymbolCounts channel{3}, number_steps{13};
    std::array<RunningMedian, 12> x_steps, y_steps;
    std::array<std::int32_t, 8> heights;
    std::array<std::uint16_t, 8> intensities;
    IntegerEncoder dx{32, 2}, dy{32, 22}, z{32, 20}, intensity{16, 4}, angle{16, 2}, source{16, 1};
    GpsTimeEncoder times;
    RgbEncoder colours;
    std::vector<ExtraByteEncoder> bytes;
  };
  struct Context {
    unsigned level, z, returns;
  };

  std::size_t extra_bytes() const { return length_ - extra_; }

  Context encode_xy(const LayeredFields& p) {
    ArithmeticEncoder& out = layers_[0];
    Channel& old = *channels_[channel_];
    const unsigned model =
        (old.last.number() == 1) + 2 * (old.last.number() >= old.last.count()) + 4 * old.time_changed;
    auto& own = channels_[p.channel()];
    if (!own) own = std::make_unique<Channel>(*this, before_);
    Channel& c = *own;
    c.time_changed = p.time != c.last.time;
    const unsigned step = (p.number() - c.last.number()) & 15u;
    const unsigned number = step == 0 ? 0 : step == 1 ? 1 : step == 15 ? 2 : 3;
    const unsigned changed = (p.channel() != channel_) << 6 | (p.source != c.last.source) << 5 | c.time_changed << 4 |
                             (p.angle != c.last.angle) << 3 | (p.count() != c.last.count()) << 2 | number;
    out.symbol(old.changed[model], changed);
    if (p.channel() != channel_) out.symbol(old.channel, (p.channel() - channel_ - 1) & 3u);
    channel_ = p.channel();
    if (changed & 4) out.symbol(c.counts[c.last.count()], p.count());
    if (number == 3)
      c.time_changed ? out.symbol(c.numbers[c.last.number()], p.number()) : out.symbol(c.number_steps, step - 2);

    const unsigned single = p.count() == 1;
    const unsigned median = laz::kReturnContext16[p.count()][p.number()] * 2u + c.time_changed;
    const std::int32_t dx = difference(p.x, c.last.x), dy = difference(p.y, c.last.y);
    c.dx.encode(out, c.x_steps[median].get(), dx, single);
    c.x_steps[median].add(dx);
    const unsigned x_class = c.dx.correction_class();
    c.dy.encode(out, c.y_steps[median].get(), dy, (x_class < 20 ? x_class & ~1u : 20u) + single);
    c.y_steps[median].add(dy);
    const unsigned mean = (x_class + c.dy.correction_class()) / 2;
    return {laz::return_level(p.count(), p.number()), (mean < 18 ? mean & ~1u : 18u) + single,
            2u * (p.number() == 1) + (p.number() >= p.count())};
  }

  std::size_t rgb_, extra_, length_;
  std::vector<ArithmeticEncoder> layers_;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  unsigned channel_ = 0;
  const std::byte* before_ = nullptr;
};

// A chunk of format 6 or 7, behind its first point. Layers of which no value changes are left out.
inline Bytes encode_layered(int format, std::size_t length, const std::byte* records, std::size_t count) {
  LayerEncoder encoder(format == 7, length, records);
  for (std::size_t i = 1; i < count; ++i) encoder.encode(records + i * length);
  std::vector<Bytes> layers = encoder.finish();
  // Where the values of a layer stand: first byte and number
  std::vector<std::array<std::size_t, 2>> places{{0, 0},  {8, 4},  {16, 1}, {15, 1}, {12, 2},
                                                 {18, 2}, {17, 1}, {20, 2}, {22, 8}};
  if (format == 7) places.push_back({30, 6});
  while (places.size() < layers.size()) places.push_back({length - (layers.size() - places.size()), 1});
  for (std::size_t layer = 1; layer < layers.size(); ++layer) {
    bool changes = false;
    for (std::size_t i = 1; i < count; ++i)
      changes |=
          std::memcmp(records + i * length + places[layer][0], records + places[layer][0], places[layer][1]) != 0;
    if (!changes) layers[layer].clear();
  }
  Bytes chunk;
  put(chunk, 0, static_cast<std::uint32_t>(count));
  for (const Bytes& layer : layers) put(chunk, chunk.size(), static_cast<std::uint32_t>(layer.size()));
  for (const Bytes& layer : layers) chunk.insert(chunk.end(), layer.begin(), layer.end());
  return chunk;
}

// The file `las` with these records, one behind the other, compressed in chunks of as many points; 0: of random sizes,
// which the table of chunks then has to state.
class LazWriter {
 public:
  LazWriter(LasFile las, Bytes records, int version)
      : las_(std::move(las)), records_(std::move(records)), version_(version) {}

  Bytes write(const std::vector<std::size_t>& chunks, bool variable) const {
    LasFile las = las_;
    las.vlrs.push_back(
        {"laszip encoded", 22204, description(variable ? 0xFFFFFFFFu : static_cast<std::uint32_t>(chunks.front()))});
    Bytes file = las.bytes();
    file.resize(las.points_begin() + 8);
    put(file, 104, static_cast<std::uint8_t>(las.format | 0x80));
    ArithmeticEncoder table;
    IntegerEncoder numbers(32, 2);
    std::int32_t last_points = 0, last_bytes = 0;
    std::size_t first = 0;
    for (const std::size_t points : chunks) {
      const std::byte* const records = records_.data() + first * las.record_length();
      const std::size_t begin = file.size();
      file.insert(file.end(), records, records + las.record_length());
      const Bytes rest =
          (las.format < 6 ? encode_pointwise : encode_layered)(las.format, las.record_length(), records, points);
      file.insert(file.end(), rest.begin(), rest.end());
      const auto bytes = static_cast<std::int32_t>(file.size() - begin);
      if (variable)
        numbers.encode(table, std::exchange(last_points, static_cast<std::int32_t>(points)),
                       static_cast<std::int32_t>(points), 0);
      numbers.encode(table, std::exchange(last_bytes, bytes), bytes, 1);
      first += points;
    }
    put(file, las.points_begin(), static_cast<std::uint64_t>(file.size()));
    put(file, file.size(), std::uint32_t{0});
    put(file, file.size(), static_cast<std::uint32_t>(chunks.size()));
    const Bytes encoded = table.finish();
    file.insert(file.end(), encoded.begin(), encoded.end());
    return file;
  }

 private:
  Bytes description(std::uint32_t chunk_points) const {
    struct Item {
      int type, size;
    };
    std::vector<Item> items{las_.format < 6 ? Item{6, 20} : Item{10, 30}};
    if (las_.format == 1 || las_.format == 3) items.push_back({7, 8});
    if (las_.format == 2 || las_.format == 3) items.push_back({8, 6});
    if (las_.format == 7) items.push_back({11, 6});
    if (las_.extra_bytes > 0) items.push_back({las_.format < 6 ? 0 : 14, static_cast<int>(las_.extra_bytes)});
    Bytes body(34);
    put(body, 0, static_cast<std::uint16_t>(las_.format < 6 ? 2 : 3));
    put(body, 12, chunk_points);
    put(body, 32, static_cast<std::uint16_t>(items.size()));
    for (const Item& item : items)
      for (const int value : {item.type, item.size, version_})
        put(body, body.size(), static_cast<std::uint16_t>(value));
    return body;
  }

  LasFile las_;
  Bytes records_;
  int version_;
};

}  // namespace stipple::test
