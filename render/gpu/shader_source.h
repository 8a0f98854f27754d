// GLSL text: embedded at build time, read from a folder while developing.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

struct EmbeddedShader {
  std::string_view name;  // "projection.glsl"
  std::string_view text;
};

// Written by the build from shaders/*.glsl.
std::span<const EmbeddedShader> embedded_shaders();

// A preprocessor symbol and its value: shader variants are defines, never copies.
struct ShaderDefine {
  std::string name;
  std::string value = "1";
};

// The complete source of a shader: version line, defines, then the file with every `#include "NAME"` replaced once by
// that file. Where the environment variable STIPPLE_SHADERS names a folder, files are read from there instead, so that
// shaders can be changed without building. Throws Error for an unknown name.
std::string shader_source(std::string_view name, const std::vector<ShaderDefine>& defines);

}  // namespace stipple
