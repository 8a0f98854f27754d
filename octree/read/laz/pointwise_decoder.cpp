#include "octree/read/laz/pointwise_decoder.h"

#include <fmt/format.h>

#include <vector>

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

// Which items a point has is known when the loop over points is compiled: kTime, kRgb.
template <class Version>
class PointwiseDecoder final : public PointDecoder {
 public:
  PointwiseDecoder(const InputFile& file, const Format& format)
      : path_(file.path()), format_(format), input_(file, longest_point(format)) {
    if (const Item* item = format.find(ItemType::wave_packet13)) wave_offset_ = item->offset;
    if (const Item* item = format.find(ItemType::bytes)) extra_offset_ = item->offset;
    if (const Item* item = format.find(ItemType::rgb12)) rgb_offset_ = item->offset;
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
    std::size_t count = records.size() / format_.record_length;
    std::byte* out = records.data();
    if (done_ == 0 && count > 0) {
      begin_items(out);
      out += format_.record_length;
      --count;
    }
    const bool time = format_.find(ItemType::gps_time11) != nullptr;
    const bool rgb = rgb_offset_ != 0;
    if (time)
      rgb ? decode_points<true, true>(out, count) : decode_points<true, false>(out, count);
    else
      rgb ? decode_points<false, true>(out, count) : decode_points<false, false>(out, count);
  }

  std::uint64_t end() override { return input_.file_offset(decoder_.at); }

 private:
  void begin_items(std::byte* out) {
    const std::byte* const first = input_.data();
    std::memcpy(out, first, format_.record_length);
    point_.begin(first);
    if (format_.find(ItemType::gps_time11)) time_.begin(first + Version::Point::kSize);
    if (rgb_offset_ != 0) rgb_.begin(first + rgb_offset_);
    if (wave_) {
      wave_->init();
      std::memcpy(packet_.data(), first + wave_offset_, packet_.size());
    }
    if (extra_offset_ != 0) extra_.begin(first + extra_offset_, format_.record_length - extra_offset_);
    decoder_.start(first + format_.record_length);
    done_ = 1;
  }

  template <bool kTime, bool kRgb>
  void decode_points(std::byte* out, std::size_t count) {
    ArithmeticDecoder decoder = decoder_;  // a copy that lives in registers
    const std::byte* limit = input_.limit();
    for (std::size_t i = 0; i < count; ++i, out += format_.record_length) {
      point_.decode(decoder, out);
      if constexpr (kTime) time_.decode(decoder, out + Version::Point::kSize);
      if constexpr (kRgb) rgb_.decode(decoder, out + Version::Point::kSize + (kTime ? Version::Time::kSize : 0));
      if (wave_) {
        wave_->decode(decoder, packet_);
        std::memcpy(out + wave_offset_, packet_.data(), packet_.size());
      }
      if (extra_offset_ != 0) extra_.decode(decoder, out + extra_offset_);
      if (decoder.at > limit || decoder.broken != 0) [[unlikely]] {
        decoder.at = go_on(decoder, done_ + i);
        limit = input_.limit();
      }
    }
    decoder_ = decoder;
    done_ += count;
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
  std::uint64_t done_ = 0;      // points of the chunk
  std::size_t rgb_offset_ = 0;  // in a record; 0: none
  std::size_t wave_offset_ = 0;
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
