// A folder that is there only once it is whole.
#pragma once

#include <string>

namespace stipple::potree2 {

// What is built for folder DIR is built in ".DIR.stipple-build-PID" beside it, which is locked while its process lives.
// commit() renames it to DIR. Destroyed without commit(), it leaves nothing behind, and a tree at DIR stays as it was.
class WriterFolder {
 public:
  // Removes what builds of DIR that were killed left behind. Throws Error when there is something at `target` already,
  // unless it is an empty folder, or a tree that `replace` allows to replace: a folder that holds a Potree 2.0 tree and
  // nothing else. Throws Error when the folder above does not exist or may not be written to.
  WriterFolder(const std::string& target, bool replace);
  ~WriterFolder();
  WriterFolder(const WriterFolder&) = delete;
  WriterFolder& operator=(const WriterFolder&) = delete;

  const std::string& path() const { return path_; }      // to build in
  const std::string& target() const { return target_; }  // absolute

  // Brings the names to the disk and puts the folder in its place; an old tree leaves it in the same moment (Linux,
  // RENAME_EXCHANGE) and is then deleted. Throws Error; then the old tree is still there.
  void commit();

 private:
  std::string target_;
  std::string path_;
  bool replace_;
  int lock_ = -1;
};

}  // namespace stipple::potree2
