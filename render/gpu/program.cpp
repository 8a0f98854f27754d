#include "render/gpu/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "octree/core/error.h"

namespace stipple {
namespace {

using ShaderHandle = Handle<gl_delete::shader>;

ShaderHandle compile(GLenum stage, std::string_view file, const std::vector<ShaderDefine>& defines) {
  const std::string source = shader_source(file, defines);
  ShaderHandle shader(glCreateShader(stage));
  const char* text = source.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  GLint length = 0;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
  throw Error(fmt::format("shader {} does not compile on this driver:\n{}", file, log.c_str()));
}

void link(GLuint program, std::string_view name) {
  glLinkProgram(program);
  GLint ok = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok) return;
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program, length, nullptr, log.data());
  throw Error(fmt::format("shader program {} does not link on this driver:\n{}", name, log.c_str()));
}

}  // namespace

Program Program::compute(std::string_view shader, const std::vector<ShaderDefine>& defines) {
  const ShaderHandle stage = compile(GL_COMPUTE_SHADER, shader, defines);
  Program program(glCreateProgram());
  glAttachShader(program.name(), stage.name());
  link(program.name(), shader);
  return program;
}

Program Program::graphics(std::string_view vertex, std::string_view fragment,
                          const std::vector<ShaderDefine>& defines) {
  const ShaderHandle vertex_stage = compile(GL_VERTEX_SHADER, vertex, defines);
  const ShaderHandle fragment_stage = compile(GL_FRAGMENT_SHADER, fragment, defines);
  Program program(glCreateProgram());
  glAttachShader(program.name(), vertex_stage.name());
  glAttachShader(program.name(), fragment_stage.name());
  link(program.name(), vertex);
  return program;
}

void dispatch_items(std::size_t items, std::size_t group_size) {
  constexpr std::size_t kMaxGroups = 65535;
  const std::size_t groups = (items + group_size - 1) / group_size;
  if (groups == 0) return;
  const std::size_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
  const std::size_t columns = (groups + rows - 1) / rows;
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(rows), 1);
}

void dispatch_pixels(const glm::ivec2& size) {
  glDispatchCompute(static_cast<GLuint>(size.x + 15) / 16, static_cast<GLuint>(size.y + 7) / 8, 1);
}

void dispatch_columns(const glm::ivec2& size) {
  glDispatchCompute(static_cast<GLuint>(size.x + 63) / 64, static_cast<GLuint>(size.y + 15) / 16, 1);
}

}  // namespace stipple
