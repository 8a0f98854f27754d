// Memory for the records of one region, taken from the system as it is touched and used again for the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace stipple {

class RecordBlock {
 public:
  RecordBlock() = default;
  ~RecordBlock();
  RecordBlock(const RecordBlock&) = delete;
  RecordBlock& operator=(const RecordBlock&) = delete;

  // At least `bytes`, of any content; what was there before may be lost. Throws std::bad_alloc.
  std::span<std::byte> reserve(std::size_t bytes);
  std::span<std::byte> bytes() const { return {address_, size_}; }
  void release();

 private:
  std::byte* address_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace stipple
