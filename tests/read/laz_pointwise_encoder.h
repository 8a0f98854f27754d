// Points of formats 0 to 5 as one stream after their first: a chunk, or all of a file that is not chunked.
#pragma once

#include "tests/read/laz_item_encoders_v1.h"
#include "tests/read/laz_record.h"

namespace stipple::test {

struct ItemEncodersV1 {
  using Point = Point10EncoderV1;
  using Time = GpsTimeEncoderV1;
  using Rgb = RgbEncoderV1;
  using Extra = ExtraBytesEncoderV1;
};
struct ItemEncodersV2 {
  using Point = Point10Encoder;
  using Time = GpsTimeEncoder;
  using Rgb = RgbEncoder;
  using Extra = ExtraBytesEncoder;
};

// What stands behind the first point. Waveform packets are the same in both versions.
template <class Version>
Bytes encode_pointwise(const RecordPlaces& at, const std::byte* records, std::size_t count) {
  const auto time_of = [&](const std::byte* record) { return value_at<std::uint64_t>(record + at.time); };
  ArithmeticEncoder out;
  typename Version::Point points(records);
  typename Version::Time times(at.time ? time_of(records) : 0);
  typename Version::Rgb colours;
  WavePacketEncoder packets;
  typename Version::Extra extra(at.extra_bytes());
  for (std::size_t i = 1; i < count; ++i) {
    const std::byte* const record = records + i * at.length;
    const std::byte* const before = record - at.length;
    points.encode(out, record);
    if (at.time) times.encode(out, time_of(record));
    if (at.rgb) colours.encode(out, before + at.rgb, record + at.rgb);
    if (at.wave) packets.encode(out, before + at.wave, record + at.wave);
    extra.encode(out, before + at.extra, record + at.extra);
  }
  return out.finish();
}

}  // namespace stipple::test
