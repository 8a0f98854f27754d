#include "octree/build/stream/spill.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace stipple {

SpillFile::SpillFile(const std::string& folder, BuildMonitor& monitor)
    : file_(folder + "/spill.part", potree2::WriterFile::Name::removed), monitor_(monitor) {}

SpillFile::Extent SpillFile::append(std::span<const std::byte> bytes) {
  const Extent extent{end_.fetch_add(bytes.size()), bytes.size()};
  file_.write_at(extent.offset, bytes);
  monitor_.add_written(extent.bytes);
  return extent;
}

void SpillFile::read(const Extent& extent, std::span<std::byte> bytes) const {
  file_.read_at(extent.offset, bytes);
  monitor_.add_read(extent.bytes);
}

void SpilledPart::append(std::span<const std::byte> records) {
  const std::lock_guard lock(mutex_);
  while (!records.empty()) {
    if (buffer_.capacity() < capacity_) buffer_.reserve(capacity_);
    const auto some = records.first(std::min(records.size(), capacity_ - buffer_.size()));
    buffer_.insert(buffer_.end(), some.begin(), some.end());
    records = records.subspan(some.size());
    if (buffer_.size() == capacity_) flush();
  }
}

void SpilledPart::flush() {
  if (!buffer_.empty()) extents_.push_back(file_->append(buffer_));
  buffer_.clear();
}

void SpilledPart::close() {
  flush();
  buffer_ = {};
}

void SpilledPart::read(const RecordConsumer& consume) const {
  tbb::enumerable_thread_specific<Buffer<std::byte>> buffers;
  tbb::parallel_for(std::size_t{0}, extents_.size(), [&](std::size_t e) {
    Buffer<std::byte>& buffer = buffers.local();
    buffer.resize(extents_[e].bytes);
    file_->read(extents_[e], buffer);
    consume(buffer);
  });
}

void SpilledPart::discard() {
  for (const SpillFile::Extent& extent : extents_) file_->discard(extent);
  extents_.clear();
}

}  // namespace stipple
