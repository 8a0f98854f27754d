// From feedback targets to colours: in the window, or as a picture.
#pragma once

#include <cstdint>

#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"
#include "render/measure/image.h"

namespace stipple {

class Display {
 public:
  struct Scene {
    const FeedbackTarget* left = nullptr;
    const FeedbackTarget* right = nullptr;  // null: one frame alone
    int divider = 0;                        // column of the picture at which the right frame begins
    std::uint32_t background = 0x808080;    // RRGGBB
  };

  Display();

  // Fills the window with the scene, stretched where it has another size.
  void show(const Scene& scene, const glm::ivec2& window_size);
  // Fills the window with a colour.
  void clear(std::uint32_t background, const glm::ivec2& window_size);
  // The scene as show() shows it in a window of the left frame's size. Waits for the GPU.
  Image picture(const Scene& scene);

 private:
  void draw(const Scene& scene, const glm::ivec2& size, bool upside_down);
  Program one_;
  Program two_;
  Handle<gl_delete::vertex_array> no_vertices_;
};

}  // namespace stipple
