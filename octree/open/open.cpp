#include "octree/open/open.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <utility>

#include "octree/open/input_files.h"
#include "octree/open/joined_source.h"
#include "octree/read/open.h"
#include "octree/store/open_tree.h"
#include "octree/store/tree_source.h"

namespace stipple {
namespace {

// A survey may have more tiles than a process may have files open by default.
void allow_many_files() {
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

std::unique_ptr<PointSource> open_source(const std::string& path) {
  return open_source(std::vector{path});
}

std::unique_ptr<PointSource> open_source(const std::vector<std::string>& paths) {
  auto sources = open_each(paths);
  if (sources.size() == 1) return std::move(sources.front());
  std::string name = paths.front();
  if (paths.size() > 1) name += fmt::format(" and {} more", paths.size() - 1);
  return std::make_unique<JoinedSource>(std::move(sources), std::move(name));
}

std::vector<std::unique_ptr<PointSource>> open_each(const std::vector<std::string>& paths) {
  std::vector<std::unique_ptr<PointSource>> sources;
  for (const std::string& path : paths)
    for (const std::string& file : input_files(path)) {
      if (sources.size() == 100) allow_many_files();
      if (is_tree(file))
        sources.push_back(std::make_unique<TreeSource>(open_tree(file)));
      else
        sources.push_back(open_file(file));
    }
  return sources;
}

}  // namespace stipple
