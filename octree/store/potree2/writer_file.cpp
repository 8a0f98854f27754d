#include "octree/store/potree2/writer_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "octree/core/error.h"

namespace stipple::potree2 {

WriterFile::WriterFile(const std::string& path, Name name) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw system_error(path, "cannot be created");
  if (name == Name::removed) ::unlink(path.c_str());
}

WriterFile::~WriterFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void WriterFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw system_error(path_, fmt::format("cannot write {} bytes at byte {}", bytes.size(), offset));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void WriterFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw system_error(path_, fmt::format("cannot read {} bytes at byte {} back", bytes.size(), offset));
    if (got == 0) throw Error(fmt::format("{}: another program shortened it while it was in use", path_));
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

void WriterFile::discard(std::uint64_t offset, std::uint64_t bytes) {
  ::fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset),
              static_cast<off_t>(bytes));
}

void WriterFile::start_sync(std::uint64_t offset, std::uint64_t bytes) {
  ::sync_file_range(descriptor_, static_cast<off_t>(offset), static_cast<off_t>(bytes), SYNC_FILE_RANGE_WRITE);
}

void WriterFile::sync() {
  if (::fsync(descriptor_) != 0) throw system_error(path_, "cannot bring all of it to the disk");
}

}  // namespace stipple::potree2
