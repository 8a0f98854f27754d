#include "octree/read/laz/point_decoder.h"

#include <fmt/format.h>

#include "octree/core/error.h"
#include "octree/read/laz/layered_decoder.h"
#include "octree/read/laz/pointwise_decoder.h"

namespace stipple::laz {

std::unique_ptr<PointDecoder> make_point_decoder(const InputFile& file, const Format& format,
                                                 std::span<const las::Field> fields) {
  if (format.compressor == Compressor::layered) return make_layered_decoder(file, format, fields);
  return make_pointwise_decoder(file, format);
}

Error chunk_error(const std::string& path, std::uint64_t offset, const Chunk& chunk, std::string_view what) {
  return file_error(
      path, offset,
      fmt::format("chunk {}, of {} points from byte {} on, {} The file is damaged or was cut off; copy or "
                  "download it again.",
                  chunk.index, chunk.points, chunk.begin, what));
}

}  // namespace stipple::laz
