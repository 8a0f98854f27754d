// The window: GLFW and nothing of what is shown in it.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace stipple {

// Places are in framebuffer pixels from the upper left corner, whatever the display's scale.
struct InputEvent {
  enum class Kind {
    press,      // of a mouse button
    release,    // of it
    move,       // of the cursor
    scroll,     // amount.y: notches, away from the user is positive
    key,        // pressed or repeated
    character,  // typed
    drop,       // files were dropped on the window
    refresh,    // the window's contents were lost, or its size, focus or state changed
  };
  Kind kind = Kind::refresh;
  int code = 0;       // button or key as GLFW numbers them, or the character
  int modifiers = 0;  // GLFW_MOD_...
  glm::dvec2 place{0.0};
  glm::dvec2 amount{0.0};
  double seconds = 0.0;  // of a clock that began with the window
  std::vector<std::string> paths{};
};

struct WindowOptions {
  glm::ivec2 size{1280, 720};  // framebuffer pixels
  std::string title = "stipple";
  bool errors_are_fatal = false;  // any error the driver reports ends the program: for tests
};

// An OpenGL 4.5 core context with a window, current on the thread that made it: the first thread of the program. One at
// a time.
class Window {
 public:
  // Throws Error that says what to install or set when there is no display or no such context.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  glm::ivec2 size() const;  // framebuffer pixels; a side may be 0
  // Nothing of it can be seen: minimised, or without extent.
  bool hidden() const;
  // How large text and lines ought to be.
  float text_scale() const;
  double seconds() const;

  // Waits for events, at most so long; 0: takes what is there.
  void wait_events(double most_seconds);
  // What came since the last call.
  std::vector<InputEvent> take_events();
  // Makes wait_events() return. Any thread.
  static void wake();

  bool is_down(int key) const;
  bool asked_to_close() const;
  void set_title(const std::string& title);
  void set_clipboard(const std::string& text);
  std::string clipboard() const;
  void hide();
  // Shows what was drawn.
  void swap();

  const std::string& renderer() const { return renderer_; }  // GL_RENDERER
  const std::string& version() const { return version_; }    // GL_VERSION

 private:
  friend class SharedContext;
  struct Library;
  void install_callbacks();
  void add(InputEvent event);
  glm::dvec2 pixels_a_unit() const;
  std::unique_ptr<Library> library_;
  GLFWwindow* window_ = nullptr;
  bool errors_are_fatal_;
  glm::dvec2 cursor_{0.0};  // of the last event: where it is now may be farther on
  std::vector<InputEvent> events_;
  std::string renderer_;
  std::string version_;
};

// A second context that sees the same buffers, textures and programs: for another thread. Made and destroyed on the
// window's thread, within its life.
class SharedContext {
 public:
  explicit SharedContext(const Window& window);
  ~SharedContext();
  SharedContext(const SharedContext&) = delete;
  SharedContext& operator=(const SharedContext&) = delete;

  // Current on the calling thread, or on none any more.
  void make_current();
  void release();

 private:
  GLFWwindow* hidden_ = nullptr;
  bool errors_are_fatal_;
};

}  // namespace stipple
