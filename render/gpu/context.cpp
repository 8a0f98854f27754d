#include "render/gpu/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "octree/core/error.h"

namespace stipple {
namespace {

// A way to get a display, not tried yet.
struct Candidate {
  std::string name;
  EGLenum platform;
  void* native;
};

std::string_view egl_string(EGLDisplay display, EGLint name) {
  const char* text = eglQueryString(display, name);
  return text ? text : "";
}

std::vector<EGLDeviceEXT> egl_devices() {
  const std::string_view client = egl_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (client.find("EGL_EXT_device_enumeration") == client.npos && client.find("EGL_EXT_device_base") == client.npos)
    return {};
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return {};
  // No braces: a list of two pointers would be a vector of two devices
  return std::vector<EGLDeviceEXT>(devices.begin(), devices.begin() + count);
}

std::vector<Candidate> candidates(EglPlatform platform) {
  std::vector<Candidate> hardware;
  std::vector<Candidate> software;
  std::vector<EGLDeviceEXT> devices;
  if (platform != EglPlatform::surfaceless) devices = egl_devices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
    const bool is_software = extensions && std::string_view(extensions).find("software") != std::string_view::npos;
    (is_software ? software : hardware)
        .push_back({fmt::format("EGL device {}", i), EGL_PLATFORM_DEVICE_EXT, devices[i]});
  }
  std::vector<Candidate> all = hardware;
  if (platform != EglPlatform::device)
    all.push_back({"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
  all.insert(all.end(), software.begin(), software.end());
  return all;
}

void GLAPIENTRY report(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                       const void* fatal) {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  std::fprintf(stderr, "stipple: OpenGL: %s\n", message);
  if (fatal) std::abort();
}

}  // namespace

void set_context_defaults(bool errors_are_fatal) {
  glEnable(GL_DEBUG_OUTPUT);
  static constexpr bool kYes = true;
  glDebugMessageCallback(report, errors_are_fatal ? &kYes : nullptr);
  if (errors_are_fatal) glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

struct HeadlessContext::Egl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~Egl() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }

  // Empty when a context is current, else why not.
  std::string open(const Candidate& candidate, bool debug) {
    display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
    if (display == EGL_NO_DISPLAY) return "no display";
    if (!eglInitialize(display, nullptr, nullptr)) {
      display = EGL_NO_DISPLAY;
      return fmt::format("does not start (EGL error 0x{:04x})", eglGetError());
    }
    if (egl_string(display, EGL_EXTENSIONS).find("EGL_KHR_surfaceless_context") == std::string_view::npos)
      return "cannot draw without a surface (EGL_KHR_surfaceless_context is missing)";
    if (!eglBindAPI(EGL_OPENGL_API)) return "has no desktop OpenGL";
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           debug ? EGL_TRUE : EGL_FALSE,
                                           EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return fmt::format("has no OpenGL 4.5 core (EGL error 0x{:04x})", eglGetError());
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
      return fmt::format("refuses a context without a surface (EGL error 0x{:04x})", eglGetError());
    return {};
  }
};

HeadlessContext::HeadlessContext(const ContextOptions& options) {
  std::string failures;
  for (const Candidate& candidate : candidates(options.platform)) {
    egl_ = std::make_unique<Egl>();
    const std::string why = egl_->open(candidate, options.errors_are_fatal);
    if (why.empty()) {
      platform_ = candidate.name;
      break;
    }
    failures += fmt::format("\n  {}: {}", candidate.name, why);
    egl_.reset();
  }
  if (!egl_)
    throw Error(
        fmt::format("no OpenGL 4.5 core context without a window could be made. Tried:{}\nInstall a driver: on "
                    "Debian, `apt install libegl1 libgl1-mesa-dri` gives one that runs on the CPU.",
                    failures));
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  version_ = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  set_context_defaults(options.errors_are_fatal);
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace stipple
