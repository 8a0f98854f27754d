#include "render/gpu/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "octree/core/error.h"

namespace stipple {
namespace {

std::string load(std::string_view name) {
  if (const char* folder = std::getenv("STIPPLE_SHADERS")) {
    const std::string path = fmt::format("{}/{}", folder, name);
    std::ifstream file(path);
    if (!file) throw Error(fmt::format("{}: cannot be read; STIPPLE_SHADERS must name the folder of shaders", path));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  const auto shaders = embedded_shaders();
  const auto found = std::ranges::find(shaders, name, &EmbeddedShader::name);
  if (found == shaders.end()) throw Error(fmt::format("shader {} does not exist", name));
  return std::string(found->text);
}

void append(std::string& out, std::string_view name, std::set<std::string, std::less<>>& seen) {
  constexpr std::string_view kInclude = "#include \"";
  std::istringstream lines(load(name));
  std::string line;
  while (std::getline(lines, line)) {
    if (!line.starts_with(kInclude)) {
      out += line + '\n';
      continue;
    }
    const std::string included = line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
    if (seen.insert(included).second) append(out, included, seen);
  }
}

}  // namespace

std::string shader_source(std::string_view name, const std::vector<ShaderDefine>& defines) {
  std::string out = "#version 450 core\n";
  for (const ShaderDefine& define : defines) out += fmt::format("#define {} {}\n", define.name, define.value);
  std::set<std::string, std::less<>> seen;
  append(out, name, seen);
  return out;
}

}  // namespace stipple
