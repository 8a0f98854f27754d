#include "octree/store/potree2/writer_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string_view>

#include "octree/core/error.h"
#include "octree/store/potree2/kd_boxes.h"
#include "octree/store/potree2/sidecar.h"

namespace stipple::potree2 {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kTreeFiles{"metadata.json", "hierarchy.bin", "octree.bin"};
// Ours alone.
constexpr std::array<std::string_view, 4> kKdFiles{kKdMetadataName, "hierarchy.bin", "octree.bin", kBoxesName};
// May be there: ours, and what PotreeConverter leaves.
constexpr std::array<std::string_view, 2> kExtraFiles{kSidecarName, "log.txt"};

// "/a/b" for "b/", ".", "../b", ...
fs::path absolute_folder(const std::string& path) {
  fs::path folder = fs::absolute(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  return folder;
}

std::string temporary_prefix(const fs::path& target) {
  return fmt::format(".{}.stipple-build-", target.filename().string());
}

void sync_folder(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

// A descriptor that holds the folder's lock, or -1 when a living process does, or it is gone.
int lock_folder(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return -1;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

void remove_leftovers(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(target.parent_path(), none)) {
    if (!entry.path().filename().string().starts_with(prefix) || !entry.is_directory(none)) continue;
    const int lock = lock_folder(entry.path().string());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), none);
    ::close(lock);
  }
}

void check_replaceable(const fs::path& target, bool replace) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(target, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw Error(fmt::format("{}: is there already and is no folder. Name another folder.", target.string()));
  if (fs::is_empty(target, error)) return;
  if (!replace)
    throw Error(fmt::format("{}: is there already. Name another folder, or replace the tree in it with --force.",
                            target.string()));
  const bool kd = fs::is_regular_file(target / kKdMetadataName, error);
  const auto files = kd ? std::span<const std::string_view>(kKdFiles) : std::span<const std::string_view>(kTreeFiles);
  for (const std::string_view name : files)
    if (!fs::is_regular_file(target / name, error))
      throw Error(fmt::format("{}: is no Potree 2.0 tree, it has no {}; it is not replaced. Name another folder.",
                              target.string(), name));
  for (const fs::directory_entry& entry : fs::directory_iterator(target)) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::find(files, name) == files.end() && std::ranges::find(kExtraFiles, name) == kExtraFiles.end())
      throw Error(
          fmt::format("{}: holds {}, which is no part of a Potree 2.0 tree, and is not replaced. Move it away, "
                      "or name another folder.",
                      target.string(), name));
  }
}

}  // namespace

WriterFolder::WriterFolder(const std::string& target, bool replace)
    : target_(absolute_folder(target).string()), replace_(replace) {
  const fs::path folder = target_;
  remove_leftovers(folder);
  check_replaceable(folder, replace);
  path_ = (folder.parent_path() / fmt::format("{}{}", temporary_prefix(folder), ::getpid())).string();
  std::error_code error;
  if (!fs::create_directory(path_, error)) {
    const std::string reason = error ? error.message() : "it is there already";
    throw Error(fmt::format("{}: cannot create {} to build it in: {}", target_, std::exchange(path_, ""), reason));
  }
  lock_ = lock_folder(path_);
}

WriterFolder::~WriterFolder() {
  std::error_code none;
  if (!path_.empty()) fs::remove_all(path_, none);
  if (lock_ >= 0) ::close(lock_);
}

void WriterFolder::commit() {
  check_replaceable(target_, replace_);  // it may have come meanwhile
  sync_folder(path_);
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    sync_folder(fs::path(target_).parent_path().string());
    return;  // the old tree now stands under the temporary name and goes with this object
  }
  // Not there, or the file system cannot exchange: the old tree goes first then
  const bool exists = errno != ENOENT;
  const std::string old = path_ + "-old";
  if (exists && std::rename(target_.c_str(), old.c_str()) != 0)
    throw system_error(target_, "the old tree cannot be moved away");
  if (std::rename(path_.c_str(), target_.c_str()) != 0) {
    const Error failure = system_error(target_, fmt::format("cannot rename {} to it", path_));
    if (exists) std::rename(old.c_str(), target_.c_str());
    throw failure;
  }
  path_ = exists ? old : "";
  sync_folder(fs::path(target_).parent_path().string());
}

}  // namespace stipple::potree2
