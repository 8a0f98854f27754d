// Whole LAZ files made for tests: all point formats, in every way in which a writer may lay them out.
#pragma once

#include <numeric>

#include "tests/read/laz_layer_encoder.h"
#include "tests/read/laz_pointwise_encoder.h"

namespace stipple::test {

// Formats 6 to 10 are never `none`: all points in one stream, without a table.
enum class Chunking { none, fixed, variable };

// Where the table of chunks is said to be: before the points, in the last eight bytes of the file by a writer that
// cannot go back; or it is not there, as that writer was interrupted before or behind what it would have said.
enum class TablePlace { before_points, end_of_file, unknown, cut_off };

struct LazLayout {
  int version = 2;                         // of the items: 1 or 2, of formats 6 to 10 3 or 4
  std::vector<std::size_t> chunks{1'000};  // points of each; fixed: all alike but the last
  Chunking chunking = Chunking::fixed;
  TablePlace table = TablePlace::before_points;

  std::size_t points() const { return std::accumulate(chunks.begin(), chunks.end(), std::size_t{0}); }
};

// The file `las` with these records, one behind the other.
class LazWriter {
 public:
  LazWriter(LasFile las, Bytes records, LazLayout layout)
      : las_(std::move(las)), at_(las_), records_(std::move(records)), layout_(std::move(layout)) {}

  Bytes write() const {
    LasFile las = las_;
    las.points = layout_.points();
    las.vlrs.push_back({"laszip encoded", 22204, description()});
    Bytes file = las.bytes();
    file.resize(las.points_begin());
    put(file, 104, static_cast<std::uint8_t>(las.format | 0x80));
    if (layout_.chunking == Chunking::none)
      append_chunk(file, records_.data(), las.points);
    else
      append_chunks(file);
    return file;
  }

 private:
  void append_chunk(Bytes& file, const std::byte* records, std::size_t count) const {
    file.insert(file.end(), records, records + at_.length);
    const Bytes rest = las_.format >= 6       ? encode_layered(at_, layout_.version, records, count)
                       : layout_.version == 1 ? encode_pointwise<ItemEncodersV1>(at_, records, count)
                                              : encode_pointwise<ItemEncodersV2>(at_, records, count);
    file.insert(file.end(), rest.begin(), rest.end());
  }

  void append_chunks(Bytes& file) const {
    const std::size_t pointer = file.size();
    put(file, pointer, std::int64_t{-1});
    std::vector<std::size_t> sizes;
    const std::byte* records = records_.data();
    for (const std::size_t points : layout_.chunks) {
      const std::size_t begin = file.size();
      append_chunk(file, records, points);
      sizes.push_back(file.size() - begin);
      records += points * at_.length;
    }
    const auto table = static_cast<std::int64_t>(file.size());
    if (layout_.table == TablePlace::cut_off) put(file, pointer, static_cast<std::int64_t>(pointer));
    if (layout_.table == TablePlace::cut_off || layout_.table == TablePlace::unknown) return;
    append_table(file, sizes);
    put(file, layout_.table == TablePlace::before_points ? pointer : file.size(), table);
  }

  void append_table(Bytes& file, const std::vector<std::size_t>& sizes) const {
    put(file, file.size(), std::uint32_t{0});
    put(file, file.size(), static_cast<std::uint32_t>(sizes.size()));
    ArithmeticEncoder out;
    IntegerEncoder numbers(32, 2);
    std::int32_t last_points = 0, last_bytes = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const auto points = static_cast<std::int32_t>(layout_.chunks[i]), bytes = static_cast<std::int32_t>(sizes[i]);
      if (layout_.chunking == Chunking::variable) numbers.encode(out, std::exchange(last_points, points), points, 0);
      numbers.encode(out, std::exchange(last_bytes, bytes), bytes, 1);
    }
    const Bytes encoded = out.finish();
    file.insert(file.end(), encoded.begin(), encoded.end());
  }

  // The body of the record that says how the points are compressed.
  Bytes description() const {
    const bool layered = las_.format >= 6;
    Bytes body(34);
    const int compressor = layered ? 3 : layout_.chunking == Chunking::none ? 1 : 2;
    put(body, 0, static_cast<std::uint16_t>(compressor));
    put(body, 12, layout_.chunking == Chunking::fixed ? static_cast<std::uint32_t>(layout_.chunks.front()) : ~0u);
    std::uint16_t items = 0;
    const auto add = [&](bool there, int type, std::size_t size, int version) {
      if (!there) return;
      put(body, 32, ++items);
      for (const std::size_t value : {static_cast<std::size_t>(type), size, static_cast<std::size_t>(version)})
        put(body, body.size(), static_cast<std::uint16_t>(value));
    };
    const int version = layout_.version;
    add(!layered, 6, 20, version);
    add(!layered && at_.time, 7, 8, version);
    add(!layered && at_.rgb, 8, 6, version);
    add(!layered && at_.wave, 9, 29, 1);  // has one version only
    add(layered, 10, 30, version);
    add(layered && at_.rgb && !at_.nir, 11, 6, version);
    add(at_.nir, 12, 8, version);
    add(layered && at_.wave, 13, 29, version);
    add(at_.extra_bytes() > 0, layered ? 14 : 0, at_.extra_bytes(), version);
    return body;
  }

  LasFile las_;
  RecordPlaces at_;
  Bytes records_;
  LazLayout layout_;
};

}  // namespace stipple::test
