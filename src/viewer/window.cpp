#include "src/viewer/window.h"

#include <epoxy/gl.h>
// After epoxy, which it must not declare again
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "octree/core/error.h"
#include "render/gpu/context.h"

namespace stipple {
namespace {

// The library's last complaint.
std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

Error no_display(const std::string& why) {
  const char* x11 = std::getenv("DISPLAY");
  return Error(fmt::format(
      "no window can be opened: {}. DISPLAY is {}. Start it in a graphical session, over `ssh -X`, or under "
      "`xvfb-run -s \"-screen 0 1280x720x24\"` (packages xvfb and xauth); `stipple render` needs no display.",
      why, x11 && *x11 ? fmt::format("\"{}\"", x11) : "not set"));
}

Error no_context(const std::string& why) {
  return Error(
      fmt::format("no window with OpenGL 4.5 can be opened: {}. Install the graphics card's driver; on Debian, `apt "
                  "install libgl1-mesa-dri` gives one that draws on the CPU, and LIBGL_ALWAYS_SOFTWARE=1 chooses it.",
                  why));
}

void set_context_hints(bool debug) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

Window& window_of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

}  // namespace

struct Window::Library {
  Library() {
    if (!glfwInit()) throw no_display(last_error());
  }
  ~Library() { glfwTerminate(); }
};

Window::Window(const WindowOptions& options)
    : library_(std::make_unique<Library>()), errors_are_fatal_(options.errors_are_fatal) {
  set_context_hints(errors_are_fatal_);
  window_ = glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
  if (!window_) throw no_context(last_error());
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  set_context_defaults(errors_are_fatal_);
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  version_ = reinterpret_cast<const char*>(glGetString(GL_VERSION));

  // On some displays a unit of the window has several pixels
  const glm::dvec2 unit = pixels_a_unit();
  if (unit != glm::dvec2(1.0)) {
    const glm::ivec2 units = glm::max(glm::ivec2(glm::round(glm::dvec2(options.size) / unit)), 1);
    glfwSetWindowSize(window_, units.x, units.y);
  }
  install_callbacks();
}

Window::~Window() {
  glfwDestroyWindow(window_);
}

glm::ivec2 Window::size() const {
  glm::ivec2 size{0};
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

bool Window::hidden() const {
  const glm::ivec2 pixels = size();
  return pixels.x <= 0 || pixels.y <= 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) ||
         !glfwGetWindowAttrib(window_, GLFW_VISIBLE);
}

glm::dvec2 Window::pixels_a_unit() const {
  glm::ivec2 units{0};
  glfwGetWindowSize(window_, &units.x, &units.y);
  const glm::ivec2 pixels = size();
  if (units.x <= 0 || units.y <= 0 || pixels.x <= 0 || pixels.y <= 0) return glm::dvec2(1.0);
  return glm::dvec2(pixels) / glm::dvec2(units);
}

float Window::text_scale() const {
  float x = 1.0f;
  float y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  // Where the window's unit has several pixels, part of the scale is in it already
  return std::clamp(std::max(x, y), 1.0f, 4.0f);
}

double Window::seconds() const {
  return glfwGetTime();
}

void Window::wait_events(double most_seconds) {
  if (most_seconds > 0.0)
    glfwWaitEventsTimeout(most_seconds);
  else
    glfwPollEvents();
}

std::vector<InputEvent> Window::take_events() {
  return std::exchange(events_, {});
}

void Window::wake() {
  glfwPostEmptyEvent();
}

bool Window::is_down(int key) const {
  return glfwGetKey(window_, key) == GLFW_PRESS;
}

bool Window::asked_to_close() const {
  return glfwWindowShouldClose(window_);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::hide() {
  glfwHideWindow(window_);
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

void Window::add(InputEvent event) {
  event.seconds = seconds();
  events_.push_back(std::move(event));
}

void Window::install_callbacks() {
  glfwSetWindowUserPointer(window_, this);
  glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
  cursor_ *= pixels_a_unit();
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* handle, int button, int action, int modifiers) {
    Window& window = window_of(handle);
    window.add({.kind = action == GLFW_PRESS ? InputEvent::Kind::press : InputEvent::Kind::release,
                .code = button,
                .modifiers = modifiers,
                .place = window.cursor_});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* handle, double x, double y) {
    Window& window = window_of(handle);
    window.cursor_ = glm::dvec2(x, y) * window.pixels_a_unit();
    window.add({.kind = InputEvent::Kind::move, .place = window.cursor_});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* handle, double x, double y) {
    Window& window = window_of(handle);
    window.add({.kind = InputEvent::Kind::scroll, .place = window.cursor_, .amount = {x, y}});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int, int action, int modifiers) {
    if (action != GLFW_RELEASE)
      window_of(handle).add({.kind = InputEvent::Kind::key, .code = key, .modifiers = modifiers});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* handle, unsigned int character) {
    window_of(handle).add({.kind = InputEvent::Kind::character, .code = static_cast<int>(character)});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* handle, int count, const char** paths) {
    window_of(handle).add({.kind = InputEvent::Kind::drop, .paths = {paths, paths + count}});
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* handle) { window_of(handle).add({}); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* handle, int, int) { window_of(handle).add({}); });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* handle, int) { window_of(handle).add({}); });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* handle, int) { window_of(handle).add({}); });
}

SharedContext::SharedContext(const Window& window) : errors_are_fatal_(window.errors_are_fatal_) {
  set_context_hints(errors_are_fatal_);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  hidden_ = glfwCreateWindow(16, 16, "stipple: loading", nullptr, window.window_);
  if (!hidden_) throw no_context("a second context for loading is refused (" + last_error() + ")");
}

SharedContext::~SharedContext() {
  // Mesa 22 keeps the program of a context's last dispatch, and has the context that first ran it look after it. Let it
  // keep one of the window's, not one whose context is gone.
  const char* const nothing = "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
  const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &nothing);
  glUseProgram(program);
  glDispatchCompute(1, 1, 1);
  glUseProgram(0);
  glDeleteProgram(program);
  glfwDestroyWindow(hidden_);
}

void SharedContext::make_current() {
  glfwMakeContextCurrent(hidden_);
  set_context_defaults(errors_are_fatal_);
}

void SharedContext::release() {
  glfwMakeContextCurrent(nullptr);
}

}  // namespace stipple
