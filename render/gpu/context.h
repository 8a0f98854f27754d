// An OpenGL 4.5 core context without a window.
#pragma once

#include <memory>
#include <string>

namespace stipple {

// Where a context without a window may come from.
enum class EglPlatform { any, surfaceless, device };

struct ContextOptions {
  // Abort on any error the driver reports: for tests. Otherwise such reports go to stderr.
  bool errors_are_fatal = false;
  EglPlatform platform = EglPlatform::any;
};

// What every context of ours is set to: depth runs from 0 to 1 (glClipControl), points take their size from the shader,
// the driver's errors are reported. The context is current.
void set_context_defaults(bool errors_are_fatal);

// Current on the thread that made it, from construction to destruction; one at a time. With
// set_context_defaults().
class HeadlessContext {
 public:
  // Tries, in this order and as far as the options allow: EGL devices that are no software (NVIDIA and others), the
  // surfaceless platform (Mesa), software devices. Throws Error saying what was tried, why each failed and what to
  // install.
  explicit HeadlessContext(const ContextOptions& options = {});
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  const std::string& platform() const { return platform_; }  // "EGL surfaceless", "EGL device 0"
  const std::string& renderer() const { return renderer_; }  // GL_RENDERER
  const std::string& version() const { return version_; }    // GL_VERSION

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
  std::string platform_;
  std::string renderer_;
  std::string version_;
};

}  // namespace stipple
