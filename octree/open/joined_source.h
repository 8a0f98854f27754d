// Several sources as one cloud.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

// The points of the first source, then those of the second, and so on: ids count through. One grid (common_grid()) and
// one schema (merged_schema()). Warnings are those of all sources, with their paths, and one more when positions were
// rounded.
class JoinedSource : public PointSource {
 public:
  // `path` stands for them all in messages. Where the grids differ, all positions are read once to find their bounds:
  // headers lie. At least one source.
  JoinedSource(std::vector<std::unique_ptr<PointSource>> sources, std::string path);

  const SourceInfo& info() const override { return info_; }

  // Batches are those of the sources. Throws Error as they do, and when one delivers another number of points than it
  // states.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  void choose_grid();
  void read_one(std::size_t s, std::span<const std::size_t> attributes, const BatchConsumer& consume) const;

  std::vector<std::unique_ptr<PointSource>> sources_;
  std::vector<std::uint64_t> first_;  // id of the first point of each
  SourceInfo info_;
};

}  // namespace stipple
