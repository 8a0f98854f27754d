// A folder of files as one array of bytes, so that a fuzzer can change any of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace stipple::fuzz {

struct NamedFile {
  std::string name;  // relative, with '/' between folders
  std::string content;
};

// Each file as kMark, its name, a newline and its content: no lengths that would have to agree with what follows.
inline constexpr const char* kMark = "\n@@file ";
std::string bytes_of(const std::vector<NamedFile>& files);

// Of any bytes. Leaves out what stands before the first mark, and files whose name could lead out of the folder.
std::vector<NamedFile> files_of(std::span<const std::uint8_t> bytes);

// A folder in main memory, removed with the object.
class MemoryFolder {
 public:
  MemoryFolder();
  ~MemoryFolder();
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void clear() const;
  // A file of that name that was there is replaced.
  void write(const std::string& name, std::span<const std::uint8_t> content) const;

 private:
  std::filesystem::path path_;
};

}  // namespace stipple::fuzz
