// Points set aside on the disk, part by part, until there is memory for them.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "octree/build/stream/inputs.h"
#include "octree/build/stream/monitor.h"
#include "octree/core/buffer.h"
#include "octree/store/potree2/writer_file.h"

namespace stipple {

// One file that parts append to in large pieces and whose room is given back as they are read.
class SpillFile {
 public:
  // In `folder`; without a name, so that it is gone with the process whatever happens.
  SpillFile(const std::string& folder, BuildMonitor& monitor);

  struct Extent {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };

  Extent append(std::span<const std::byte> bytes);
  void read(const Extent& extent, std::span<std::byte> bytes) const;
  void discard(const Extent& extent) { file_.discard(extent.offset, extent.bytes); }
  std::uint64_t bytes() const { return end_; }  // ever appended

 private:
  potree2::WriterFile file_;
  BuildMonitor& monitor_;
  std::atomic<std::uint64_t> end_{0};
};

// The records of one part.
class SpilledPart {
 public:
  // Collects in `buffer`, of whole records, before it writes; refers to it until close().
  SpilledPart(SpillFile& file, std::span<std::byte> buffer) : file_(&file), buffer_(buffer) {}

  // From several threads at once.
  void append(std::span<const std::byte> records);
  // After the last append().
  void close() { flush(); }

  // Gives `consume`, from several threads at once, all records in batches.
  void read(const RecordConsumer& consume) const;
  // When they are not read again.
  void discard();

 private:
  void flush();

  SpillFile* file_;
  std::span<std::byte> buffer_;
  std::size_t buffered_ = 0;  // bytes
  std::mutex mutex_;
  std::vector<SpillFile::Extent> extents_;
};

}  // namespace stipple
