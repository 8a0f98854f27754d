// Move-only owners of one OpenGL object each. All need a current context, also to be destroyed.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace stipple {

// `Delete` frees the name; name 0 owns nothing.
template <auto Delete>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_) Delete(name_);
  }

  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

namespace gl_delete {
inline void buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
inline void query(GLuint name) {
  glDeleteQueries(1, &name);
}
inline void texture(GLuint name) {
  glDeleteTextures(1, &name);
}
inline void framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
inline void vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}
inline void shader(GLuint name) {
  glDeleteShader(name);
}
inline void program(GLuint name) {
  glDeleteProgram(name);
}
}  // namespace gl_delete

}  // namespace stipple
