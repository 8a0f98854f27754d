// A file that is there only once it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace stipple {

// Written under a temporary name beside `path` ("PATH.part-PID-N"); commit() gives it its own. Destroyed without
// commit(), it leaves nothing behind, and a file that was at `path` before stays as it was.
class OutputFile {
 public:
  // Throws Error when the folder does not exist or may not be written to, or when `path` is a folder, device or pipe:
  // those cannot be replaced.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Puts `bytes` at `offset`. May be called from several threads at once. Throws Error with the system's reason, a full
  // disk for example.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);

  // Waits until all is on the disk, then replaces what is at `path`. Throws Error; then nothing was replaced.
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;  // empty when committed
  int descriptor_ = -1;
};

// Writes a whole file in one go, through an OutputFile; devices and pipes (/dev/stdout) are written in place.
void write_file(const std::string& path, std::span<const std::byte> contents);
void write_file(const std::string& path, std::string_view contents);

}  // namespace stipple
