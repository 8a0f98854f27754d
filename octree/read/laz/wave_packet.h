// Waveform packet of a point: index of its description, place and size in the file of waveforms, place of the return,
// and a direction. 29 bytes, alike in formats 4, 5, 9 and 10.
#pragma once

#include "octree/read/laz/item_common.h"

namespace stipple::laz {

// Source: LASzip specification, "WAVEPACKET13" and "WAVEPACKET14".
class WavePacketDecoder {
 public:
  static constexpr std::size_t kSize = 29;
  using Packet = std::array<std::byte, kSize>;

  void init() {
    index_.init();
    for (auto& model : offset_kinds_) model.init();
    offset_.init();
    size_.init();
    place_.init();
    direction_.init();
    last_kind_ = 0;
    last_offset_step_ = 0;
  }

  // Replaces the last packet by the next.
  void decode(ArithmeticDecoder& decoder, Packet& packet) {
    std::byte* const p = packet.data();
    const auto size = load<std::int32_t>(p + 9);
    p[0] = static_cast<std::byte>(decoder.symbol(index_));
    store(p + 1, offset(decoder, load<std::uint64_t>(p + 1), static_cast<std::uint32_t>(size)));
    store(p + 9, size_.decode(decoder, size));
    store(p + 13, place_.decode(decoder, load<std::int32_t>(p + 13)));
    for (unsigned axis = 0; axis < 3; ++axis) {
      std::byte* const at = p + 17 + 4 * axis;
      store(at, direction_.decode(decoder, load<std::int32_t>(at), axis));
    }
  }

 private:
  std::uint64_t offset(ArithmeticDecoder& decoder, std::uint64_t last, std::uint32_t last_size) {
    last_kind_ = decoder.symbol(offset_kinds_[last_kind_]);
    switch (last_kind_) {
      case 0:
        return last;
      case 1:
        return last + last_size;
      case 2:
        last_offset_step_ = offset_.decode(decoder, last_offset_step_);
        return last + static_cast<std::uint64_t>(std::int64_t{last_offset_step_});
      default:
        return decoder.bits64();
    }
  }

  SymbolModel<256> index_;
  std::array<SymbolModel<4>, 4> offset_kinds_;  // by the last one
  IntegerDecoder<32, 1> offset_;
  IntegerDecoder<32, 1> size_;
  IntegerDecoder<32, 1> place_;
  IntegerDecoder<32, 3> direction_;
  unsigned last_kind_ = 0;
  std::int32_t last_offset_step_ = 0;
};

}  // namespace stipple::laz
