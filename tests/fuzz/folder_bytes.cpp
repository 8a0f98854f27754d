#include "tests/fuzz/folder_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

namespace stipple::fuzz {
namespace {

constexpr std::size_t kLongestName = 100;

bool is_safe(std::string_view name) {
  if (name.empty() || name.size() > kLongestName || name.front() == '/' || name.back() == '/') return false;
  if (name.find("..") != name.npos || name.find("//") != name.npos) return false;
  return std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '-' || c == '/'; });
}

}  // namespace

std::string bytes_of(const std::vector<NamedFile>& files) {
  std::string bytes;
  for (const NamedFile& file : files) bytes += kMark + file.name + "\n" + file.content;
  return bytes;
}

std::vector<NamedFile> files_of(std::span<const std::uint8_t> bytes) {
  const std::string_view mark = kMark;
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<NamedFile> files;
  for (std::size_t at = all.find(mark); at != all.npos;) {
    const std::size_t next = all.find(mark, at + 1);
    const std::string_view file = all.substr(at + mark.size(), next == all.npos ? next : next - at - mark.size());
    const std::size_t line = file.find('\n');
    if (line != file.npos && is_safe(file.substr(0, line)))
      files.push_back({std::string(file.substr(0, line)), std::string(file.substr(line + 1))});
    at = next;
  }
  return files;
}

MemoryFolder::MemoryFolder() {
  const std::filesystem::path memory = "/dev/shm";
  const auto base = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  path_ = base / ("stipple-fuzz-" + std::to_string(::getpid()));
  std::filesystem::create_directories(path_);
}

MemoryFolder::~MemoryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void MemoryFolder::clear() const {
  for (const auto& entry : std::filesystem::directory_iterator(path_)) std::filesystem::remove_all(entry.path());
}

void MemoryFolder::write(const std::string& name, std::span<const std::uint8_t> content) const {
  std::error_code taken;  // by a folder of that name, or a file where a folder should be: then it is not written
  std::filesystem::create_directories((path_ / name).parent_path(), taken);
  std::ofstream out(path_ / name, std::ios::binary);
  out.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
}

}  // namespace stipple::fuzz
