#include "tests/window/x_display.h"

// X first: it defines words that others use
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#undef Status
#undef None
#undef Bool
#undef Success

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

extern char** environ;

namespace stipple::test {
namespace {

::Display* display_of(void* connection) {
  return static_cast<::Display*>(connection);
}

// The number Xvfb has chosen; empty when it did not start.
std::string read_number(int pipe) {
  std::string number;
  for (char c = 0; ::read(pipe, &c, 1) == 1 && c != '\n';) number += c;
  return number;
}

}  // namespace

XDisplay::XDisplay() {
  int ends[2];
  if (::pipe(ends) != 0) return;
  const std::string descriptor = std::to_string(ends[1]);
  std::string arguments[] = {"Xvfb", "-displayfd", descriptor, "-screen", "0", "1920x1080x24", "-nolisten", "tcp"};
  char* argv[9] = {};
  for (int i = 0; i < 8; ++i) argv[i] = arguments[i].data();
  const bool started = ::posix_spawnp(&process_, "Xvfb", nullptr, nullptr, argv, environ) == 0;
  ::close(ends[1]);
  const std::string number = started ? read_number(ends[0]) : "";
  ::close(ends[0]);
  if (number.empty()) return;
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
  connection_ = ::XOpenDisplay(nullptr);
}

XDisplay::~XDisplay() {
  if (connection_) ::XCloseDisplay(display_of(connection_));
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

void XDisplay::move(int x, int y) const {
  ::XTestFakeMotionEvent(display_of(connection_), -1, x, y, 0);
  ::XSync(display_of(connection_), 0);
}

void XDisplay::button(int number, bool down) const {
  ::XTestFakeButtonEvent(display_of(connection_), static_cast<unsigned>(number), down, 0);
  ::XSync(display_of(connection_), 0);
}

void XDisplay::click(int number) const {
  button(number, true);
  button(number, false);
}

void XDisplay::key(const std::string& name, bool down) const {
  const KeyCode code = ::XKeysymToKeycode(display_of(connection_), ::XStringToKeysym(name.c_str()));
  ::XTestFakeKeyEvent(display_of(connection_), code, down, 0);
  ::XSync(display_of(connection_), 0);
}

void XDisplay::press(const std::string& name) const {
  key(name, true);
  key(name, false);
}

unsigned long XDisplay::window() const {
  ::Display* display = display_of(connection_);
  ::Window root = 0;
  ::Window parent = 0;
  ::Window* children = nullptr;
  unsigned count = 0;
  ::XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  ::Window found = 0;
  for (unsigned i = 0; i < count; ++i) {
    XWindowAttributes attributes;
    if (::XGetWindowAttributes(display, children[i], &attributes) && attributes.map_state == IsViewable)
      found = children[i];
  }
  if (children) ::XFree(children);
  return found;
}

void XDisplay::resize_window(int width, int height) const {
  ::XResizeWindow(display_of(connection_), window(), static_cast<unsigned>(width), static_cast<unsigned>(height));
  ::XSync(display_of(connection_), 0);
}

}  // namespace stipple::test
