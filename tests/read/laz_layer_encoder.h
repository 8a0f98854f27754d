// Points of formats 6 to 10 as layers, versions 3 and 4. Source: LASzip specification, "POINT14", "RGB14", "RGBNIR14",
// "WAVEPACKET14" and "BYTE14".
#pragma once

#include <memory>

#include "tests/read/laz_item_encoders.h"
#include "tests/read/laz_record.h"

namespace stipple::test {

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

// The nine layers of POINT14. Each channel has models of its own.
class PointLayersEncoder {
 public:
  explicit PointLayersEncoder(const std::byte* first) : channel_(LayeredFields(first).channel()) {
    channels_[channel_] = std::make_unique<Channel>(LayeredFields(first));
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
    c.last = p;
  }

  std::vector<Bytes> finish() {
    std::vector<Bytes> streams;
    for (ArithmeticEncoder& layer : layers_) streams.push_back(layer.finish());
    return streams;
  }

 private:
  struct Channel {
    explicit Channel(const LayeredFields& before) : last(before), times(last.time, 0) {
      heights.fill(last.z);
      intensities.fill(last.intensity);
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
  };
  struct Context {
    unsigned level, z, returns;
  };

  Context encode_xy(const LayeredFields& p) {
    ArithmeticEncoder& out = layers_[0];
    Channel& old = *channels_[channel_];
    const unsigned model =
        (old.last.number() == 1) + 2 * (old.last.number() >= old.last.count()) + 4 * old.time_changed;
    auto& own = channels_[p.channel()];
    if (!own) own = std::make_unique<Channel>(old.last);
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

  std::array<ArithmeticEncoder, 9> layers_;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  unsigned channel_;
};

// One layer of what stands behind POINT14. Version 4 has models and a last value for each channel. Version 3 means
// the same, but takes channel 0 for every point whose channel is that of the point before, and when it goes back to a
// channel, the last value of the one it comes from is predicted from and replaced.
template <class Models>
class ItemLayerEncoder {
 public:
  ItemLayerEncoder(std::size_t place, std::size_t bytes, const std::byte* first, int version)
      : place_(place), bytes_(bytes), version_(version), point_channel_(LayeredFields(first).channel()) {
    channel_ = point_channel_;
    models_[channel_].emplace();
    lasts_[channel_] = item(first);
  }

  void encode(const std::byte* record) {
    const unsigned before = std::exchange(point_channel_, LayeredFields(record).channel());
    const unsigned to = version_ >= 4 || point_channel_ != before ? point_channel_ : 0;
    const unsigned from = std::exchange(channel_, to);
    const bool is_new = !models_[to];
    if (is_new) {
      models_[to].emplace();
      lasts_[to] = lasts_[from];
    }
    Bytes& last = lasts_[is_new || version_ >= 4 ? to : from];
    models_[to]->encode(out_, last.data(), record + place_);
    last = item(record);
  }
  Bytes finish() { return out_.finish(); }

 private:
  Bytes item(const std::byte* record) const { return {record + place_, record + place_ + bytes_}; }

  std::size_t place_, bytes_;
  int version_;
  unsigned point_channel_;  // of the last point
  unsigned channel_;        // whose models it took
  ArithmeticEncoder out_;
  std::array<std::optional<Models>, 4> models_;
  std::array<Bytes, 4> lasts_;
};

// The layers of a chunk. One of which no value changes is empty.
class LayersEncoder {
 public:
  LayersEncoder(const RecordPlaces& at, int version, const std::byte* records, std::size_t count)
      : length_(at.length), version_(version), records_(records), count_(count) {
    PointLayersEncoder points(records);
    for (std::size_t i = 1; i < count; ++i) points.encode(records + i * length_);
    constexpr std::size_t kPlaces[9][2] = {{0, 16}, {8, 4},  {16, 1}, {15, 1}, {12, 2},
                                           {18, 2}, {17, 1}, {20, 2}, {22, 8}};
    const std::vector<Bytes> streams = points.finish();
    layers_.push_back(streams.front());
    for (std::size_t layer = 1; layer < streams.size(); ++layer)
      add(kPlaces[layer][0], kPlaces[layer][1], [&] { return streams[layer]; });
    if (at.rgb) add_item<RgbEncoder>(at.rgb, 6);
    if (at.nir) add_item<NirEncoder>(at.nir, 2);
    if (at.wave) add_item<WavePacketEncoder>(at.wave, 29);
    for (std::size_t place = at.extra; place < at.length; ++place) add_item<ExtraBytesEncoder>(place, 1);
  }
  const std::vector<Bytes>& layers() const { return layers_; }

 private:
  template <class Models>
  void add_item(std::size_t place, std::size_t bytes) {
    add(place, bytes, [&] {
      ItemLayerEncoder<Models> item(place, bytes, records_, version_);
      for (std::size_t i = 1; i < count_; ++i) item.encode(records_ + i * length_);
      return item.finish();
    });
  }
  template <class Encode>
  void add(std::size_t place, std::size_t bytes, const Encode& encode) {
    bool changes = false;
    for (std::size_t i = 1; i < count_; ++i)
      changes |= std::memcmp(records_ + i * length_ + place, records_ + place, bytes) != 0;
    layers_.push_back(changes ? encode() : Bytes{});
  }

  std::size_t length_;
  int version_;
  const std::byte* records_;
  std::size_t count_;
  std::vector<Bytes> layers_;
};

// A chunk behind its first point.
inline Bytes encode_layered(const RecordPlaces& at, int version, const std::byte* records, std::size_t count) {
  const LayersEncoder encoder(at, version, records, count);
  Bytes chunk;
  put(chunk, 0, static_cast<std::uint32_t>(count));
  for (const Bytes& layer : encoder.layers()) put(chunk, chunk.size(), static_cast<std::uint32_t>(layer.size()));
  for (const Bytes& layer : encoder.layers()) chunk.insert(chunk.end(), layer.begin(), layer.end());
  return chunk;
}

}  // namespace stipple::test
