// Points from a LAZ file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/read/input_file.h"
#include "octree/read/las/las_header.h"
#include "octree/read/laz/chunk_table.h"
#include "octree/read/laz/laz_format.h"

namespace stipple {

// LASzip-compressed LAS 1.0 to 1.5, point formats 0 to 10, extra bytes; files that are not chunked, of chunks of a
// fixed and of variable size; items of versions 1 to 4. Schema, grid and values are those of the LAS file that was
// compressed.
class LazSource : public PointSource {
 public:
  // Reads the header and the table of chunks. Throws Error as las::parse_header(), laz::read_format() and
  // laz::read_chunk_table() do, when the file cannot be opened, and when it is not compressed. A file that states more
  // points than is plausible for its size is decoded once.
  explicit LazSource(const std::string& path);

  const SourceInfo& info() const override { return info_; }

  // Batches of at most 65,536 points of one chunk, begun in file order; a core decodes whole chunks. Files that are
  // not chunked are decoded on one. Memory: a few MiB a core, and of point formats 6 to 10 the layers of a chunk.
  // Throws std::out_of_range for an index that is none of the schema.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  void read_chunks(const std::vector<las::Field>& fields, const BatchConsumer& consume) const;
  void read_without_table(const std::vector<las::Field>& fields, const BatchConsumer& consume) const;

  InputFile file_;
  las::Header header_;
  laz::Format format_;
  SourceInfo info_;
  laz::ChunkTable table_;
};

}  // namespace stipple
