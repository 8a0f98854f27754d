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
    const auto some = records.first(std::min(records.size(), buffer_.size() - buffered_));
    std::copy(some.begin(), some.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(buffered_));
    buffered_ += some.size();
    records = records.subspan(some.size());
    if (buffered_ == buffer_.size()) flush();
  }
}

void SpilledPart::flush() {
  if (buffered_ > 0) extents_.push_back(file_->append(buffer_.first(buffered_)));
  buffered_ = 0;
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
