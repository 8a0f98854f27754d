#include "octree/open/input_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "octree/core/error.h"
#include "octree/store/open_tree.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kExtensions{".las", ".laz", ".ply", ".pcd", ".obj",
                                                      ".xyz", ".pts", ".asc", ".e57"};

bool is_cloud_file(const fs::directory_entry& entry) {
  std::string extension = entry.path().extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return entry.is_regular_file() && std::ranges::find(kExtensions, extension) != kExtensions.end();
}

}  // namespace

std::vector<std::string> input_files(const std::string& path) {
  if (!fs::is_directory(path) || is_tree(path)) return {path};
  std::vector<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
    if (is_cloud_file(entry)) files.push_back(entry.path().string());
  if (error) throw Error(fmt::format("{}: cannot be listed: {}", path, error.message()));
  if (files.empty()) throw Error(fmt::format("{}: the folder holds no point cloud files. Check the path.", path));
  std::ranges::sort(files);
  return files;
}

}  // namespace stipple
