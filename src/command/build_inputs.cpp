#include "src/command/build_inputs.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "src/cli/cli.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;

// In a folder anything may stand: these are taken for clouds, whether they can be read today or not, so that none is
// left out in silence.
constexpr std::array<std::string_view, 7> kExtensions{".las", ".laz", ".ply", ".pcd", ".xyz", ".pts", ".e57"};

bool is_cloud_file(const fs::directory_entry& entry) {
  std::string extension = entry.path().extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return entry.is_regular_file() && std::ranges::find(kExtensions, extension) != kExtensions.end();
}

std::vector<std::string> files_of(const std::string& path) {
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

// A survey may have more tiles than a process may have files open by default.
void allow_many_files() {
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

std::vector<std::unique_ptr<PointSource>> open_inputs(const std::vector<std::string>& paths) {
  allow_many_files();
  std::vector<std::unique_ptr<PointSource>> sources;
  for (const std::string& path : paths)
    for (const std::string& file : files_of(path)) {
      sources.push_back(open_source(file));
      for (const std::string& warning : sources.back()->info().warnings) warn(fmt::format("{}: {}", file, warning));
    }
  return sources;
}

}  // namespace stipple
