// A display of our own, and a hand at its mouse and keyboard.
#pragma once

#include <string>

namespace stipple::test {

// Starts Xvfb, with DISPLAY set to it, until destroyed.
class XDisplay {
 public:
  // 1920x1080 pixels. See running().
  XDisplay();
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;

  // False where there is no Xvfb.
  bool running() const { return connection_ != nullptr; }

  void move(int x, int y) const;  // pixels of the screen
  void button(int number, bool down) const;
  void click(int number) const;
  void key(const std::string& name, bool down) const;  // as X names keys: "F1", "w", "Control_L"
  void press(const std::string& name) const;           // down and up
  void resize_window(int width, int height) const;     // of the one window that can be seen

 private:
  unsigned long window() const;
  int process_ = -1;
  void* connection_ = nullptr;
};

}  // namespace stipple::test
