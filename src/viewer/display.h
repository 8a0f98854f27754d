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
    const FeedbackTarget* right = nullptr;  // of the same size; null: one frame alone
    int divider = 0;                        // first column of the right frame
    std::uint32_t background = 0x808080;    // RRGGBB
  };

  Display();

  // Fills the window with the scene, or with the background where the scene has another size.
  void show(const Scene& scene, const glm::ivec2& window_size);
  // Fills the window with a colour.
  void clear(std::uint32_t background, const glm::ivec2& window_size);
  // The scene as show() shows it. Waits for the GPU.
  Image picture(const Scene& scene);

 private:
  void draw(const Scene& scene, bool upside_down);
  Program program_;
  Handle<gl_delete::vertex_array> no_vertices_;
};

}  // namespace stipple
