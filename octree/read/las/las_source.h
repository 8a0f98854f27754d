// Points from an uncompressed LAS file.
#pragma once

#include <span>
#include <string>

#include "octree/cloud/source.h"
#include "octree/read/input_file.h"
#include "octree/read/las/las_header.h"

namespace stipple {

// LAS 1.0 to 1.5, point formats 0 to 10, extra bytes. Every field of a point is an attribute: see las::point_fields()
// and las::append_extra_bytes().
class LasSource : public PointSource {
 public:
  // Reads the header. Throws Error as las::parse_header() does, and when the file cannot be opened.
  explicit LasSource(const std::string& path);

  const SourceInfo& info() const override { return info_; }

  // Batches of at most 65,536 points, begun in file order. Memory: a few MiB a core, whatever the file.
  // Throws std::out_of_range for an index that is none of the schema.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  InputFile file_;
  las::Header header_;
  SourceInfo info_;
};

}  // namespace stipple
