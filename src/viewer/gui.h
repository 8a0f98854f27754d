// Dear ImGui in the window.
#pragma once

#include "src/viewer/window.h"

namespace stipple {

// One at a time, within the window's life, on its thread. Receives the window's events beside us.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin_frame();
  // Draws what was put there since begin_frame() over what the window shows.
  void end_frame();

  // Whether the panels, not the picture, are meant.
  bool takes_mouse() const;
  bool takes_keys() const;
};

}  // namespace stipple
