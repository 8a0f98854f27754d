#include "octree/core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "octree/core/error.h"

namespace stipple {
namespace {

// A process that writes one path twice at once, or a crash long ago, may have taken the first names.
constexpr int kMaxAttempts = 100;

// Makes a rename last through a power cut. Not every file system can; the file itself is safe either way.
void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

bool exists_but_no_file(const std::string& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

void write_in_place(const std::string& path, std::span<const std::byte> contents) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw system_error(path, "cannot be written");
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const Error error = system_error(path, "cannot be written");
      ::close(descriptor);
      throw error;
    }
    contents = contents.subspan(static_cast<std::size_t>(written));
  }
  ::close(descriptor);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  if (exists_but_no_file(path))
    throw Error(fmt::format("{}: is a folder, a device or a pipe; name a file to write", path));
  for (int attempt = 0; attempt < kMaxAttempts && descriptor_ < 0; ++attempt) {
    temporary_path_ = fmt::format("{}.part-{}-{}", path, ::getpid(), attempt);
    descriptor_ = ::open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) throw system_error(path, fmt::format("cannot create {} to write it", temporary_path_));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

void OutputFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw system_error(path_, fmt::format("cannot write {} bytes at byte {}", bytes.size(), offset));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void OutputFile::commit() {
  if (::fsync(descriptor_) != 0) throw system_error(path_, "cannot bring all of it to the disk");
  if (::close(std::exchange(descriptor_, -1)) != 0) throw system_error(path_, "cannot finish writing it");
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0)
    throw system_error(path_, fmt::format("cannot rename {} to it", temporary_path_));
  temporary_path_.clear();
  sync_folder_of(path_);
}

void write_file(const std::string& path, std::span<const std::byte> contents) {
  if (exists_but_no_file(path)) return write_in_place(path, contents);
  OutputFile file(path);
  file.write_at(0, contents);
  file.commit();
}

void write_file(const std::string& path, std::string_view contents) {
  write_file(path, std::as_bytes(std::span(contents)));
}

}  // namespace stipple
