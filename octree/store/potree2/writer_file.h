// A file of a tree that is being built: no name of its own to keep, the folder's rename makes it whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace stipple::potree2 {

// Owns one open descriptor. All functions may be called from several threads at once and throw Error with path and
// the system's reason.
class WriterFile {
 public:
  enum class Name { kept, removed };  // removed at once: the file is gone when the process is, however that ends

  explicit WriterFile(const std::string& path, Name name = Name::kept);
  ~WriterFile();
  WriterFile(const WriterFile&) = delete;
  WriterFile& operator=(const WriterFile&) = delete;

  const std::string& path() const { return path_; }
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  // All of `bytes`, which were written before.
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  // Gives room back to the disk where the file system can; those bytes are not read again.
  void discard(std::uint64_t offset, std::uint64_t bytes);
  // Begins to bring what was written to the disk, without waiting.
  void start_sync(std::uint64_t offset, std::uint64_t bytes);
  void sync();

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace stipple::potree2
