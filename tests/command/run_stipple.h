// Runs the built program as a user would.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "octree/read/las/las_writer.h"
#include "src/json/json.h"
#include "src/scene/scene.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test {

struct Outcome {
  int code = -1;  // exit code; -1 when a signal ended the program
  std::string out;
  std::string err;
};

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// `arguments` go through the shell. The file for stderr is gone afterwards.
inline Outcome run_stipple(const ScratchFolder& folder, const std::string& arguments) {
  Outcome outcome;
  const std::string errors = folder.path("stderr");
  std::FILE* pipe = ::popen((std::string(STIPPLE_PROGRAM) + " " + arguments + " 2> " + errors).c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.out.append(buffer.data(), count);
  const int status = ::pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.err = text_of(errors);
  std::filesystem::remove(errors);
  return outcome;
}

// A generated city as a LAS file in the folder.
inline std::string city_file(const ScratchFolder& folder, std::uint64_t points, const std::string& name = "city.las") {
  write_las(*make_scene("city", points, 1), folder.path(name));
  return folder.path(name);
}

inline Json json_file(const std::string& path) {
  return Json::parse(text_of(path));
}

}  // namespace stipple::test
