// Records of points made for tests of LAZ.
#pragma once

#include <random>

#include "tests/read/laz_record.h"

namespace stipple::test {

// How the values of a record follow one another.
enum class Kind { random, smooth, constant };

class RecordMaker {
 public:
  // `channels`: how many of the scanner's four occur in formats 6 to 10, `first_channel` and those above it.
  RecordMaker(const LasFile& las, Kind kind, unsigned channels, unsigned first_channel = 0)
      : at_(las),
        layered_(las.format >= 6),
        points_(las.points),
        kind_(kind),
        channels_(channels),
        first_channel_(first_channel),
        random_(static_cast<unsigned>(las.format) + 1) {}

  Bytes make() {
    Bytes records(points_ * at_.length);
    for (std::size_t i = 0; i < points_; ++i) {
      std::byte* const record = records.data() + i * at_.length;
      if (kind_ == Kind::random)
        for (std::size_t b = 0; b < at_.length; ++b) record[b] = static_cast<std::byte>(random_());
      if (kind_ == Kind::smooth) make_smooth(record, i);
      if (layered_)
        record[15] = static_cast<std::byte>((std::to_integer<unsigned>(record[15]) & 0xCFu) |
                                            (first_channel_ + random_() % channels_) % 4 << 4);
    }
    return records;
  }

 private:
  template <class T>
  static void set(std::byte* place, T value) {
    std::memcpy(place, &value, sizeof value);
  }

  void make_smooth(std::byte* record, std::size_t i) {
    x_ += static_cast<std::int32_t>(random_() % 60) - 20;
    set(record, x_);
    set(record + 4, x_ / 2 - static_cast<std::int32_t>(random_() % 9));
    set(record + 8, 1000 + x_ % 77);
    for (std::size_t b = 12; b < at_.length; ++b)
      record[b] = static_cast<std::byte>(random_() % 8 == 0 ? random_() % 5 : 1);
    // Four pulses at a time, steps that repeat, and jumps
    if (i % 3 == 0) time_ += random_() % 40 == 0 ? std::uint64_t{1} << 40 : 1000 * (1 + random_() % 12) + random_() % 3;
    if (at_.time) set(record + at_.time, time_ + (random_() % 2 << 36));
    if (at_.wave) make_wave(record + at_.wave);
  }

  // Packets that follow one another, that several returns share, with gaps, and in another place of the file.
  void make_wave(std::byte* packet) {
    const unsigned what = static_cast<unsigned>(random_() % 16);
    if (what < 8) wave_offset_ += wave_bytes_;
    if (what == 8 || what == 9) wave_offset_ += 60 + random_() % 7;
    if (what == 10) wave_offset_ = random_() % (std::uint64_t{1} << 45);
    wave_bytes_ = what % 2 == 0 ? 256 : 160;
    set(packet + 1, wave_offset_);
    set(packet + 9, wave_bytes_);
    for (std::size_t place = 13; place < 29; place += 4)
      set(packet + place, static_cast<float>(random_() % 100) * (place == 13 ? 10.0f : 1e-4f));
  }

  RecordPlaces at_;
  bool layered_;
  std::size_t points_;
  Kind kind_;
  unsigned channels_, first_channel_;
  std::mt19937_64 random_;
  std::int32_t x_ = 0;
  std::uint64_t time_ = std::uint64_t{1} << 60;
  std::uint64_t wave_offset_ = 60;
  std::uint32_t wave_bytes_ = 256;
};

// A file of that point format, with extra bytes: "a" of one byte and "b" of two.
inline LasFile las_for_laz(int format, std::size_t points) {
  LasFile las;
  las.minor = format < 4 ? 2 : format < 6 ? 3 : 4;
  las.format = format;
  las.extra_bytes = 3;
  las.points = points;
  las.vlrs = {extra_bytes_record({{"a", 1}, {"b", 3}})};
  return las;
}

}  // namespace stipple::test
