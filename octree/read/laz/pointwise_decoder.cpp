#include "octree/read/laz/pointwise_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "octree/read/laz/pointwise_items.h"
#include "octree/read/laz/pointwise_items_v1.h"
#include "octree/read/laz/wave_packet.h"

namespace stipple::laz {
namespace {

struct Version1 {
  using Point = Point10V1;
  using Time = GpsTime11V1;
  using Rgb = Rgb12V1;
  using Extra = BytesV1;
};
struct Version2 {
  using Point = Point10;
  using Time = GpsTime11;
  using Rgb = Rgb12;
  using Extra = Bytes;
};

// A point takes fewer than 30 symbols of 2 bytes and as many raw bits, and of extra bytes two symbols each.
std::size_t longest_point(const Format& format) {
  return 256 + 8 * format.record_length + ArithmeticDecoder::kReadAhead;
}

template <class Version>
class PointwiseDecoder final : public PointDecoder {
 public:
  PointwiseDecoder(const InputFile& file, const Format& format)
      : path_(file.path()), format_(format), input_(file, longest_point(format)) {
    if (const Item* item = format.find(ItemType::wave_packet13)) wave_offset_ = item->offset;
    if (const Item* item = format.find(ItemType::bytes)) extra_offset_ = item->offset;
    has_time_ = format.find(ItemType::gps_time11) != nullptr;
    has_rgb_ = format.find(ItemType::rgb12) != nullptr;
    if (wave_offset_ != 0) wave_ = std::make_unique<WavePacketDecoder>();
  }

  void begin(const Chunk& chunk) override {
    chunk_ = chunk;
    done_ = 0;
    input_.begin(chunk);
    const std::size_t start = format_.record_length + ArithmeticDecoder::kStartBytes;
    // A chunk of one point may do without a stream
    if (chunk.bytes < format_.record_length || (chunk.points > 1 && chunk.bytes < start))
      throw chunk_error(path_, chunk.begin, chunk,
                        fmt::format("has {} bytes, and {} or more were expected.", chunk.bytes, start));
  }

  void decode(std::span<std::byte> records) override {
    const Lane lane = take_up(records);
    run(lane.count, lane);
  }

  void decode_both(std::span<std::byte> records, PointDecoder& other, std::span<std::byte> other_records) override {
    auto& partner = static_cast<PointwiseDecoder&>(other);
    Lane lane = take_up(records);
    Lane other_lane = partner.take_up(other_records);
    const std::size_t both = std::min(lane.count, other_lane.count);
    run(both, lane, other_lane);
    decode(records.last((lane.count - both) * format_.record_length));
    partner.decode(other_records.last((other_lane.count - both) * format_.record_length));
  }

  std::uint64_t end() override { return input_.file_offset(decoder_.at); }

 private:
  void begin_items(std::byte* out) {
    const std::byte* const first = input_.data();
    std::memcpy(out, first, format_.record_length);
    point_.begin(first);
    if (has_time_) time_.begin(first + Version::Point::kSize);
    if (has_rgb_) rgb_.begin(first + Version::Point::kSize + (has_time_ ? Version::Time::kSize : 0));
    if (wave_) {
      wave_->init();
      std::memcpy(packet_.data(), first + wave_offset_, packet_.size());
    }
    if (extra_offset_ != 0) extra_.begin(first + extra_offset_, format_.record_length - extra_offset_);
    decoder_.start(first + format_.record_length);
    done_ = 1;
  }

  // What the loop over points keeps of a chunk in registers.
  struct Lane {
    PointwiseDecoder* self;
    std::byte* out;
    std::size_t count;  // points to decode
    ArithmeticDecoder decoder;
    const std::byte* limit;
    typename Version::Point::Context context;
  };

  Lane take_up(std::span<std::byte> records) {
    Lane lane{this, records.data(), records.size() / format_.record_length, {}, nullptr, {}};
    if (done_ == 0 && lane.count > 0) {
      begin_items(lane.out);
      lane.out += format_.record_length;
      --lane.count;
    }
    lane.decoder = decoder_;
    lane.limit = input_.limit();
    return lane;
  }

  // Decodes `count` points of every lane.
  template <class... Lanes>
  void run(std::size_t count, const Lanes&... lanes) {
    if (has_time_)
      has_rgb_ ? run_items<true, true>(count, lanes...) : run_items<true, false>(count, lanes...);
    else
      has_rgb_ ? run_items<false, true>(count, lanes...) : run_items<false, false>(count, lanes...);
  }

  // The lanes take turns, step by step: a step waits for the one before, and what another chunk needs does not.
  template <bool kTime, bool kRgb, class... Lanes>
  static void run_items(std::size_t count, Lanes... lanes) {
    constexpr std::size_t kTimeAt = Version::Point::kSize;
    constexpr std::size_t kRgbAt = kTimeAt + (kTime ? Version::Time::kSize : 0);
    for (std::size_t i = 0; i < count; ++i) {
      point_steps(std::make_integer_sequence<unsigned, Version::Point::kSteps>{}, lanes...);
      if constexpr (kTime) (lanes.self->time_.decode(lanes.decoder, lanes.out + kTimeAt), ...);
      if constexpr (kRgb) (lanes.self->rgb_.decode(lanes.decoder, lanes.out + kRgbAt), ...);
      (lanes.self->finish_point(lanes, i), ...);
    }
    ((lanes.self->decoder_ = lanes.decoder), ...);
    ((lanes.self->done_ += count), ...);
  }

  template <unsigned... kSteps, class... Lanes>
  [[gnu::always_inline]] static void point_steps(std::integer_sequence<unsigned, kSteps...>, Lanes&... lanes) {
    (point_step<kSteps>(lanes...), ...);
  }
  template <unsigned kStep, class... Lanes>
  [[gnu::always_inline]] static void point_step(Lanes&... lanes) {
    (lanes.self->point_.template decode<kStep>(lanes.decoder, lanes.context, lanes.out), ...);
  }

  [[gnu::always_inline]] void finish_point(Lane& lane, std::size_t index) {
    if (wave_) {
      wave_->decode(lane.decoder, packet_);
      std::memcpy(lane.out + wave_offset_, packet_.data(), packet_.size());
    }
    if (extra_offset_ != 0) extra_.decode(lane.decoder, lane.out + extra_offset_);
    if (lane.decoder.at > lane.limit || lane.decoder.broken != 0) [[unlikely]] {
      lane.decoder.at = go_on(lane.decoder, done_ + index);
      lane.limit = input_.limit();
    }
    lane.out += format_.record_length;
  }

  // Moves the window on. `point` is the one just decoded, counted in the chunk.
  [[gnu::noinline]] const std::byte* go_on(const ArithmeticDecoder& decoder, std::uint64_t point) {
    if (decoder.broken != 0)
      throw chunk_error(
          path_, input_.file_offset(decoder.at), chunk_,
          fmt::format("is damaged: what was found for point {} is nothing that an encoder writes.", point));
    if (!input_.at_end()) return input_.advance(decoder.at);
    throw chunk_error(path_, input_.file_offset(input_.limit()), chunk_, fmt::format("ends in its point {}.", point));
  }

  const std::string path_;
  const Format format_;
  ChunkInput input_;
  Chunk chunk_;
  std::uint64_t done_ = 0;  // points of the chunk
  bool has_time_ = false;
  bool has_rgb_ = false;
  std::size_t wave_offset_ = 0;  // in a record; 0: none
  std::size_t extra_offset_ = 0;

  ArithmeticDecoder decoder_;
  typename Version::Point point_;
  typename Version::Time time_;
  typename Version::Rgb rgb_;
  typename Version::Extra extra_;
  std::unique_ptr<WavePacketDecoder> wave_;
  WavePacketDecoder::Packet packet_;
};

}  // namespace

std::unique_ptr<PointDecoder> make_pointwise_decoder(const InputFile& file, const Format& format) {
  if (format.version == 1) return std::make_unique<PointwiseDecoder<Version1>>(file, format);
  return std::make_unique<PointwiseDecoder<Version2>>(file, format);
}

}  // namespace stipple::laz
