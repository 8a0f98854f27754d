// A libFuzzer target: the bytes are a file, or the files of a folder (see folder_bytes.h), which is opened and read.
// Targets differ in the seeds that they begin with. FUZZ_FILE: the file's name; empty for a folder.
#include <tbb/global_control.h>

#include "octree/core/error.h"
#include "tests/fuzz/folder_bytes.h"
#include "tests/fuzz/read_all.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // One thread, so that a finding is the same each time; other targets have the other cores
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  static const stipple::fuzz::MemoryFolder folder;
  const std::string file = FUZZ_FILE;
  if (file.empty()) {
    folder.clear();
    for (const auto& [name, content] : stipple::fuzz::files_of({data, size}))
      folder.write(name, {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
  } else {
    folder.write(file, {data, size});
  }
  try {
    stipple::fuzz::read_all((folder.path() / file).string());
  } catch (const stipple::Error&) {
    // What is damaged ought to end so, and in no other way
  }
  return 0;
}
