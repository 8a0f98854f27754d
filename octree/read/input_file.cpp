#include "octree/read/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "octree/core/error.h"

namespace stipple {

FileMapping::FileMapping(int descriptor, std::size_t size, const std::string& path) : size_(size) {
  if (size == 0) return;
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
  if (address == MAP_FAILED) throw system_error(path, "cannot be mapped into memory");
  address_ = address;
}

FileMapping::~FileMapping() {
  if (address_) ::munmap(address_, size_);
}

InputFile::InputFile(const std::string& path) : path_(path) {
  // Asked before opening: opening a pipe would wait for somebody to write into it
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) throw Error(fmt::format("{}: there is no such file. Check the path.", path));
    throw system_error(path, "cannot be opened");
  }
  if (S_ISDIR(status.st_mode)) throw Error(fmt::format("{}: is a folder, and a file was expected.", path));
  if (!S_ISREG(status.st_mode))
    throw Error(fmt::format("{}: is a device or a pipe, and a file was expected. Save its content first.", path));

  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw system_error(path, "cannot be opened");
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void InputFile::read_at(std::uint64_t offset, std::span<std::byte> destination) const {
  while (!destination.empty()) {
    const ssize_t got = ::pread(descriptor_, destination.data(), destination.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw system_error(path_, fmt::format("at byte {}: cannot be read", offset));
    if (got == 0)
      throw file_error(path_, offset,
                       fmt::format("the file ends here but had {} bytes when it was opened. Another program shortened "
                                   "it; open it again when that one is done.",
                                   size_));
    destination = destination.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

FileMapping InputFile::map() const {
  return {descriptor_, static_cast<std::size_t>(size_), path_};
}

}  // namespace stipple
