// The arithmetic coder of LAZ from the writer's side, as its specification has it and not faster: what the decoder is
// tested with where no real files are there. Source: LASzip specification, "Arithmetic coder" and "Integer compressor".
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/octree/las_fixture.h"

namespace stipple::test {

// How often each symbol was seen, and what share of the interval it has: brought up to date now and then.
class SymbolCounts {
 public:
  explicit SymbolCounts(std::uint32_t symbols = 256) : counts_(symbols, 1), begins_(symbols), cycle_(symbols) {
    update();
    cycle_ = left_ = (symbols + 6) / 2;
  }

  std::uint32_t symbols() const { return static_cast<std::uint32_t>(counts_.size()); }
  std::uint32_t begin(std::uint32_t symbol) const { return begins_[symbol]; }
  void count(std::uint32_t symbol) {
    ++counts_[symbol];
    if (--left_ == 0) update();
  }

 private:
  void update() {
    total_ += cycle_;
    if (total_ > 1u << 15) {
      total_ = 0;
      for (std::uint32_t& count : counts_) total_ += count = (count + 1) / 2;
    }
    const std::uint32_t scale = 0x80000000u / total_;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      begins_[i] = scale * sum >> 16;
      sum += counts_[i];
    }
    cycle_ = left_ = std::min(5 * cycle_ / 4, (symbols() + 6) * 8);
  }

  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> begins_;  // of a symbol's share, in 2^-15
  std::uint32_t total_ = 0;
  std::uint32_t cycle_;
  std::uint32_t left_ = 0;
};

class BitCounts {
 public:
  std::uint32_t zero_share() const { return share_; }  // in 2^-13
  void count(bool bit) {
    zeros_ += !bit;
    if (--left_ > 0) return;
    total_ += cycle_;
    if (total_ > 1u << 13) {
      total_ = (total_ + 1) / 2;
      zeros_ = (zeros_ + 1) / 2;
      total_ += zeros_ == total_;
    }
    share_ = zeros_ * (0x80000000u / total_) >> 18;
    cycle_ = left_ = std::min(5 * cycle_ / 4, 64u);
  }

 private:
  std::uint32_t share_ = 1u << 12;
  std::uint32_t zeros_ = 1;
  std::uint32_t total_ = 2;
  std::uint32_t cycle_ = 4;
  std::uint32_t left_ = 4;
};

class ArithmeticEncoder {
 public:
  void symbol(SymbolCounts& model, std::uint32_t symbol) {
    const std::uint32_t unit = length_ >> 15;
    const std::uint32_t low = model.begin(symbol) * unit;
    const std::uint32_t high = symbol + 1 == model.symbols() ? length_ : model.begin(symbol + 1) * unit;
    take(low, high - low);
    model.count(symbol);
  }
  void bit(BitCounts& model, bool bit) {
    const std::uint32_t low = model.zero_share() * (length_ >> 13);
    bit ? take(low, length_ - low) : take(0, low);
    model.count(bit);
  }
  void bits(std::uint32_t value, unsigned count) {
    if (count > 19) {
      bits(value & 0xFFFF, 16);
      value >>= 16;
      count -= 16;
    }
    const std::uint32_t share = length_ >> count;
    take(value * share, share);
  }
  void bits64(std::uint64_t value) {
    bits(static_cast<std::uint32_t>(value), 32);
    bits(static_cast<std::uint32_t>(value >> 32), 32);
  }
  // What it wrote; it ends where the decoder's does.
  Bytes finish() {
    const bool wide = length_ > 1u << 25;
    wide ? take(1u << 24, 1u << 23) : take(1u << 23, 1u << 15);
    bytes_.insert(bytes_.end(), wide ? 3 : 2, std::byte{0});
    return std::move(bytes_);
  }

 private:
  // The part [low, low + length) of the interval, which then is widened a byte at a time.
  void take(std::uint32_t low, std::uint32_t length) {
    const std::uint32_t before = base_;
    base_ += low;
    length_ = length;
    if (base_ < before) carry();
    for (; length_ < 1u << 24; length_ <<= 8) {
      bytes_.push_back(static_cast<std::byte>(base_ >> 24));
      base_ <<= 8;
    }
  }
  void carry() {
    auto last = bytes_.rbegin();
    for (; *last == std::byte{255}; ++last) *last = std::byte{0};
    *last = static_cast<std::byte>(std::to_integer<int>(*last) + 1);
  }

  std::uint32_t base_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFu;
  Bytes bytes_;
};

// Integers of `bits` bits as corrections of what was expected.
class IntegerEncoder {
 public:
  IntegerEncoder(unsigned bits, unsigned contexts) : bits_(bits), classes_(contexts, SymbolCounts(bits + 1)) {
    for (unsigned k = 1; k <= bits; ++k) corrections_.emplace_back(1u << std::min(k, 8u));
  }

  void encode(ArithmeticEncoder& out, std::int32_t expected, std::int32_t value, unsigned context = 0) {
    std::int64_t c =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(expected));
    const std::int64_t range = std::int64_t{1} << bits_;
    if (c < -range / 2) c += range;
    if (c >= range / 2) c -= range;
    // Class k: from -(2^k - 1) to 2^k
    class_ = 0;
    for (auto rest = static_cast<std::uint64_t>(c <= 0 ? -c : c - 1); rest > 0; rest >>= 1) ++class_;
    out.symbol(classes_.at(context), class_);
    if (class_ == 0) return out.bit(zero_or_one_, c == 1);
    if (class_ == 32) return;
    const auto place = static_cast<std::uint32_t>(c < 0 ? c + (std::int64_t{1} << class_) - 1 : c - 1);
    const unsigned raw = class_ > 8 ? class_ - 8 : 0;
    out.symbol(corrections_[class_ - 1], place >> raw);
    if (raw > 0) out.bits(place & ((1u << raw) - 1), raw);
  }
  unsigned correction_class() const { return class_; }

 private:
  unsigned bits_;
  std::vector<SymbolCounts> classes_;
  std::vector<SymbolCounts> corrections_;
  BitCounts zero_or_one_;
  unsigned class_ = 0;
};

}  // namespace stipple::test
