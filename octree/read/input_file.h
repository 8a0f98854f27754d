// A file opened for reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace stipple {

// Read-only view of a whole file. The mapping ends with the object; the file may be closed before.
class FileMapping {
 public:
  FileMapping(int descriptor, std::size_t size, const std::string& path);
  ~FileMapping();
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(address_), size_}; }

 private:
  void* address_ = nullptr;  // null when the file is empty
  std::size_t size_ = 0;
};

// Owns one open descriptor. All functions may be called from several threads at once.
class InputFile {
 public:
  // Throws Error when there is no such file, when it is a folder or anything else but a file, or may not be read.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  // bytes, when it was opened

  // Fills `destination` with the bytes from `offset` on. Throws Error when the file has become shorter than that, or
  // the device fails.
  void read_at(std::uint64_t offset, std::span<std::byte> destination) const;

  // For headers, where any byte may be wanted. A mapped file that another program shortens kills the process when it is
  // touched, so what takes long goes through read_at(), which is also the faster of the two (see las_source.cpp).
  FileMapping map() const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace stipple
