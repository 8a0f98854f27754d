#include "octree/build/stream/record_block.h"

#include <sys/mman.h>

#include <new>

namespace stipple {

RecordBlock::~RecordBlock() {
  release();
}

void RecordBlock::release() {
  if (address_) ::munmap(address_, size_);
  address_ = nullptr;
  size_ = 0;
}

std::span<std::byte> RecordBlock::reserve(std::size_t bytes) {
  if (bytes <= size_) return this->bytes();
  release();
  void* const address = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (address == MAP_FAILED) throw std::bad_alloc();
  ::madvise(address, bytes, MADV_HUGEPAGE);  // a wish: fewer page faults
  address_ = static_cast<std::byte*>(address);
  size_ = bytes;
  return this->bytes();
}

}  // namespace stipple
