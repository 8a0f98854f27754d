// Shader programs.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "render/gpu/handle.h"
#include "render/gpu/shader_source.h"

namespace stipple {

// A linked program. Move-only. Throws Error with the driver's log when compiling or linking fails.
class Program {
 public:
  Program() = default;

  static Program compute(std::string_view shader, const std::vector<ShaderDefine>& defines = {});
  static Program graphics(std::string_view vertex, std::string_view fragment,
                          const std::vector<ShaderDefine>& defines = {});

  GLuint name() const { return handle_.name(); }
  void use() const { glUseProgram(name()); }

 private:
  explicit Program(GLuint name) : handle_(name) {}
  Handle<gl_delete::program> handle_;
};

// Runs the program in use on at least `items` invocations of work groups of `group_size`, folding the groups into two
// dimensions where one is not enough (the least every driver gives is 65535 groups).
void dispatch_items(std::size_t items, std::size_t group_size);

// Runs the program in use on every pixel of a picture, in work groups of 16 x 8.
void dispatch_pixels(const glm::ivec2& size);

// The same with an invocation for several pixels: shaders/column.glsl, which has no barriers to wait at.
void dispatch_columns(const glm::ivec2& size);

}  // namespace stipple
