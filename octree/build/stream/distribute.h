// Sorting a batch of records by the part of the cloud they belong to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octree/build/morton.h"
#include "octree/build/stream/cell_map.h"
#include "octree/build/stream/record.h"
#include "octree/core/buffer.h"

namespace stipple {

// Codes of records, or of positions, in blocks that stay in the first-level cache.
template <class PositionAt, class Consumer>
void for_each_code_block(std::size_t count, const Quantizer& quantizer, const PositionAt& position_at,
                         const Consumer& consume) {
  std::uint64_t codes[1024];
  for (std::size_t first = 0; first < count; first += std::size(codes)) {
    const std::size_t block = std::min(std::size(codes), count - first);
    for (std::size_t i = 0; i < block; ++i) codes[i] = quantizer.code(position_at(first + i));
    consume(first, std::span<const std::uint64_t>(codes, block));
  }
}

// The records of one batch, those of one part together. Reused from batch to batch; one a thread.
class Distributor {
 public:
  Distributor(const CellMap& map, const Quantizer& quantizer, std::size_t record_bytes)
      : map_(&map), quantizer_(quantizer), record_bytes_(record_bytes), counts_(map.parts().size()) {}

  // Finds the part of each record; touched() then says which parts there are and count() how many of each.
  void assign(std::span<const std::byte> records) {
    for (const std::uint32_t part : touched_) counts_[part] = 0;
    touched_.clear();
    const std::size_t count = records.size() / record_bytes_;
    part_.resize(count);
    for_each_code_block(
        count, quantizer_, [&](std::size_t i) { return position_of(records.data() + i * record_bytes_); },
        [&](std::size_t first, std::span<const std::uint64_t> codes) {
          for (std::size_t i = 0; i < codes.size(); ++i) {
            const std::uint32_t part = part_[first + i] = map_->part_of(codes[i]);
            if (counts_[part]++ == 0) touched_.push_back(part);
          }
        });
  }
  std::span<const std::uint32_t> touched() const { return touched_; }
  std::size_t count(std::uint32_t part) const { return counts_[part]; }

  // Copies each record to next[part], which moves on by one record.
  void scatter(std::span<const std::byte> records, std::span<std::byte*> next) const {
    const std::byte* from = records.data();
    for (const std::uint32_t part : part_) {
      copy_record(from, record_bytes_, next[part]);
      next[part] += record_bytes_;
      from += record_bytes_;
    }
  }

 private:
  const CellMap* map_;
  Quantizer quantizer_;
  std::size_t record_bytes_;
  Buffer<std::uint32_t> part_;  // of each record
  std::vector<std::size_t> counts_;
  std::vector<std::uint32_t> touched_;
};

}  // namespace stipple
