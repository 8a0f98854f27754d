// The layers of point formats 6 to 10: each value of a point stands in a stream of its own. What a point shares with
// its predecessor, and with the returns of its pulse, is in the first layer; the others take their contexts from it.
// Source: LASzip specification, "POINT14", "RGB14", "RGBNIR14", "WAVEPACKET14", "BYTE14", versions 3 and 4.
#pragma once

#include <type_traits>

#include "octree/read/laz/gps_time.h"
#include "octree/read/laz/item_common.h"
#include "octree/read/laz/return_context.h"
#include "octree/read/laz/wave_packet.h"

namespace stipple::laz {

inline constexpr unsigned kChannels = 4;  // of a scanner; each has models of its own

// What the first layer says of a point, for the others.
struct PointContext {
  std::uint8_t channel;
  std::uint8_t item_channel;  // whose models colours, waveforms and extra bytes use; see ItemLayer
  std::uint8_t level;         // return_level()
  std::uint8_t z_context;
  std::uint8_t returns;  // 1: last of its pulse, 2: first
  bool time_changed;
  bool source_changed;
  bool angle_changed;
};

// A layer of which every channel has its own State. States are made when a channel first occurs in a chunk, from the
// value of the point before.
template <class State>
class ChannelStates {
 public:
  // For the first point of a chunk, which has the value `first`. No other channel is known then.
  template <class... Args>
  void restart(unsigned channel, const Args&... first) {
    ready_ = {};
    prepare(channel, first...);
  }
  bool has(unsigned channel) const { return ready_[channel]; }
  template <class... Args>
  [[gnu::always_inline]] State& at(unsigned channel, const Args&... last) {
    if (!ready_[channel]) [[unlikely]]
      prepare(channel, last...);
    return *states_[channel];
  }

 private:
  template <class... Args>
  [[gnu::noinline]] void prepare(unsigned channel, const Args&... last) {
    if (!states_[channel]) states_[channel] = std::make_unique_for_overwrite<State>();
    states_[channel]->init(last...);
    ready_[channel] = true;
  }

  std::array<bool, kChannels> ready_{};
  std::array<std::unique_ptr<State>, kChannels> states_;
};

// Channel, returns, x and y; and which of the others change.
class ReturnsXyLayer {
 public:
  // `first`: the chunk's first record, as all begin() below.
  void begin(const std::byte* first);
  // Writes x, y, returns and channel of a point to its record.
  [[gnu::always_inline]] PointContext decode(ArithmeticDecoder& decoder, std::byte* out);

 private:
  struct Last {
    std::int32_t x, y;
    unsigned number, count;  // of the return and of returns
    bool time_changed;
  };
  struct State {
    Last last;
    std::array<SymbolModel<128>, 8> changed;
    SymbolModel<3> channel;
    LazyModels<16, 16> counts;
    LazyModels<16, 16> numbers;
    SymbolModel<13> number_steps;
    IntegerDecoder<32, 2> dx;
    IntegerDecoder<32, 22> dy;
    std::array<Median, 12> x_steps;
    std::array<Median, 12> y_steps;

    void init(const Last& from);
  };

  static unsigned next_number(ArithmeticDecoder& decoder, State& state, unsigned changed);

  ChannelStates<State> states_;
  unsigned channel_ = 0;
};

inline void ReturnsXyLayer::State::init(const Last& from) {
  last = from;
  last.time_changed = false;
  for (auto& model : changed) model.init();
  channel.init();
  counts.forget();
  numbers.forget();
  number_steps.init();
  dx.init();
  dy.init();
  for (auto& median : x_steps) median.init();
  for (auto& median : y_steps) median.init();
}

inline void ReturnsXyLayer::begin(const std::byte* first) {
  const unsigned returns = load<std::uint8_t>(first + 14);
  channel_ = load<std::uint8_t>(first + 15) >> 4 & 3u;
  states_.restart(channel_,
                  Last{load<std::int32_t>(first), load<std::int32_t>(first + 4), returns & 15u, returns >> 4, false});
}

inline unsigned ReturnsXyLayer::next_number(ArithmeticDecoder& decoder, State& state, unsigned changed) {
  const unsigned last = state.last.number;
  switch (changed & 3u) {
    case 0:
      return last;
    case 1:
      return (last + 1) & 15u;
    case 2:
      return (last + 15) & 15u;
    default:
      if (changed & 16u) return decoder.symbol(state.numbers[last]);
      return (last + decoder.symbol(state.number_steps) + 2) & 15u;
  }
}

[[gnu::always_inline]] inline PointContext ReturnsXyLayer::decode(ArithmeticDecoder& decoder, std::byte* out) {
  State* state = &states_.at(channel_, Last{});
  const Last& before = state->last;
  const unsigned model =
      (before.number == 1 ? 1u : 0u) + (before.number >= before.count ? 2u : 0u) + (before.time_changed ? 4u : 0u);
  const unsigned changed = decoder.symbol(state->changed[model]);
  const bool channel_changed = changed & 64u;
  if (channel_changed) {
    channel_ = (channel_ + decoder.symbol(state->channel) + 1) % kChannels;
    state = &states_.at(channel_, before);
  }
  Last& last = state->last;
  const bool time_changed = changed & 16u;
  if (changed & 4u) last.count = decoder.symbol(state->counts[last.count]);
  last.number = next_number(decoder, *state, changed);

  const unsigned median = kReturnContext16[last.count][last.number] * 2u + time_changed;
  const bool single = last.count == 1;
  const std::int32_t dx = state->dx.decode(decoder, state->x_steps[median].get(), single);
  const std::int32_t x = wrapping_add(last.x, dx);
  last.x = x;
  state->x_steps[median].add(dx);
  const unsigned x_class = state->dx.correction_class();
  const std::int32_t dy =
      state->dy.decode(decoder, state->y_steps[median].get(), (x_class < 20 ? x_class & ~1u : 20u) + single);
  const std::int32_t y = wrapping_add(last.y, dy);
  last.y = y;
  state->y_steps[median].add(dy);
  last.time_changed = time_changed;

  store(out, x);
  store(out + 4, y);
  store(out + 14, static_cast<std::uint8_t>(last.count << 4 | last.number));
  store(out + 15, static_cast<std::uint8_t>((load<unsigned char>(out + 15) & 0xCFu) | channel_ << 4));
  const unsigned mean_class = (x_class + state->dy.correction_class()) / 2;
  return {static_cast<std::uint8_t>(channel_),
          static_cast<std::uint8_t>(channel_changed ? channel_ : 0u),
          static_cast<std::uint8_t>(return_level(last.count, last.number)),
          static_cast<std::uint8_t>((mean_class < 18 ? mean_class & ~1u : 18u) + single),
          static_cast<std::uint8_t>((last.number == 1 ? 2u : 0u) + (last.number >= last.count ? 1u : 0u)),
          time_changed,
          (changed & 32u) != 0,
          (changed & 8u) != 0};
}

// A layer of one value, which stands at kAt of a record. Models, one for each channel: init(before) takes the value of
// the point before, whatever its channel; decode() returns the next.
template <class Models, std::size_t kAt>
class ValueLayer {
 public:
  using Value = typename Models::Value;
  static constexpr std::size_t kOffset = kAt;

  void begin(unsigned channel, Value first) { states_.restart(channel, first); }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context, Value before) {
    return states_.at(context.channel, before).decode(decoder, context);
  }

 private:
  ChannelStates<Models> states_;
};

struct ZModels {
  using Value = std::int32_t;
  std::array<Value, kReturnLevels> heights;
  IntegerDecoder<32, 20> z;

  void init(Value before) {
    heights.fill(before);
    z.init();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    Value& height = heights[context.level];
    height = z.decode(decoder, height, context.z_context);
    return height;
  }
};
using ZLayer = ValueLayer<ZModels, 8>;

struct ClassificationModels {
  using Value = std::uint8_t;
  Value last;
  LazyModels<256, 64> models;

  void init(Value before) {
    last = before;
    models.forget();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    const unsigned model = (last & 31u) * 2 + (context.returns == 3);
    last = static_cast<Value>(decoder.symbol(models[model]));
    return last;
  }
};
using ClassificationLayer = ValueLayer<ClassificationModels, 16>;

// Classification flags, direction and edge; the channel between them stays.
struct FlagsModels {
  using Value = std::uint8_t;
  unsigned last;  // six bits
  LazyModels<64, 64> models;

  void init(Value before) {
    last = (before & 15u) | (before >> 2 & 48u);
    models.forget();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    last = decoder.symbol(models[last]);
    return static_cast<Value>((last & 15u) | (last & 48u) << 2 | static_cast<unsigned>(context.channel) << 4);
  }
};
using FlagsLayer = ValueLayer<FlagsModels, 15>;

struct IntensityModels {
  using Value = std::uint16_t;
  std::array<Value, 8> lasts;
  IntegerDecoder<16, 4> intensity;

  void init(Value before) {
    lasts.fill(before);
    intensity.init();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    Value& last = lasts[context.returns * 2u + context.time_changed];
    last = static_cast<Value>(intensity.decode(decoder, last, context.returns));
    return last;
  }
};
using IntensityLayer = ValueLayer<IntensityModels, 12>;

struct ScanAngleModels {
  using Value = std::int16_t;
  Value last;
  IntegerDecoder<16, 2> angle;

  void init(Value before) {
    last = before;
    angle.init();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    if (context.angle_changed) last = static_cast<Value>(angle.decode(decoder, last, context.time_changed));
    return last;
  }
};
using ScanAngleLayer = ValueLayer<ScanAngleModels, 18>;

struct UserDataModels {
  using Value = std::uint8_t;
  Value last;
  LazyModels<256, 64> models;

  void init(Value before) {
    last = before;
    models.forget();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext&) {
    last = static_cast<Value>(decoder.symbol(models[last / 4u]));
    return last;
  }
};
using UserDataLayer = ValueLayer<UserDataModels, 17>;

struct PointSourceModels {
  using Value = std::uint16_t;
  Value last;
  IntegerDecoder<16, 1> source;

  void init(Value before) {
    last = before;
    source.init();
  }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    if (context.source_changed) last = static_cast<Value>(source.decode(decoder, last));
    return last;
  }
};
using PointSourceLayer = ValueLayer<PointSourceModels, 20>;

struct GpsTimeModels {
  using Value = std::uint64_t;  // the bits of a double
  GpsTimeDecoder<0> times;

  void init(Value before) { times.init(before); }
  [[gnu::always_inline]] Value decode(ArithmeticDecoder& decoder, const PointContext& context) {
    return context.time_changed ? times.decode(decoder) : times.last();
  }
};
using GpsTimeLayer = ValueLayer<GpsTimeModels, 22>;

// Values as they stand in a record.
template <class Value>
Value load_item(const std::byte* at) {
  if constexpr (std::is_same_v<Value, Colour>)
    return Colour::load(at);
  else
    return load<Value>(at);
}
template <class Value>
[[gnu::always_inline]] inline void store_item(std::byte* at, const Value& value) {
  if constexpr (std::is_same_v<Value, Colour>)
    value.store(at);
  else
    store(at, value);
}

// The models of colours and what follows them belong to channels, too, but version 3 of the format takes channel 0 for
// every point whose channel is that of the point before, and goes on with the last value of another channel. That was a
// mistake of its writer; files are made so, and version 4 came to correct it.
template <class Models>
class ItemLayer {
 public:
  using Value = typename Models::Value;

  void begin(unsigned channel, const Value& first, bool corrected) {
    corrected_ = corrected;
    states_.restart(channel, first);
    channel_ = channel;
    state_ = &states_.at(channel, first);
  }
  [[gnu::always_inline]] const Value& decode(ArithmeticDecoder& decoder, const PointContext& context) {
    const unsigned channel = corrected_ ? context.channel : context.item_channel;
    Value* last = &state_->last;
    if (channel != channel_) [[unlikely]]
      last = change_channel(channel);
    state_->models.decode(decoder, *last);
    return *last;
  }

 private:
  struct State {
    Value last;
    Models models;
    void init(const Value& before) {
      last = before;
      models.init();
    }
  };

  // Returns the value that the next continues.
  Value* change_channel(unsigned channel) {
    Value* const last = &state_->last;
    const bool is_new = !states_.has(channel);
    state_ = &states_.at(channel, *last);
    channel_ = channel;
    return is_new || corrected_ ? &state_->last : last;
  }

  bool corrected_ = false;
  unsigned channel_ = 0;
  State* state_ = nullptr;
  ChannelStates<State> states_;
};

struct RgbModels {
  using Value = Colour;
  ColourModels models;
  void init() { models.init(); }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, Value& last) { last = models.decode(decoder, last); }
};

struct NirModels {
  using Value = std::uint16_t;
  SymbolModel<4> changed;
  std::array<SymbolModel<256>, 2> differences;
  void init() {
    changed.init();
    for (auto& model : differences) model.init();
  }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, Value& last) {
    const unsigned change = decoder.symbol(changed);
    unsigned low = last & 255u;
    unsigned high = last >> 8u;
    if (change & 1u) low = (low + decoder.symbol(differences[0])) & 255u;
    if (change & 2u) high = (high + decoder.symbol(differences[1])) & 255u;
    last = static_cast<Value>(high << 8 | low);
  }
};

struct WaveModels {
  using Value = WavePacketDecoder::Packet;
  WavePacketDecoder models;
  void init() { models.init(); }
  void decode(ArithmeticDecoder& decoder, Value& last) { models.decode(decoder, last); }
};

struct ByteModels {
  using Value = std::uint8_t;
  SymbolModel<256> model;
  void init() { model.init(); }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, Value& last) {
    last = static_cast<Value>(last + decoder.symbol(model));
  }
};

}  // namespace stipple::laz
