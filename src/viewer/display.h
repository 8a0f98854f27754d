// From feedback targets to colours: in the window, or as a picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "render/frame/eye_dome.h"
#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"
#include "render/measure/image.h"
#include "src/viewer/wires.h"

namespace stipple {

class Display {
 public:
  struct Scene {
    const FeedbackTarget* left = nullptr;
    const FeedbackTarget* right = nullptr;     // null: one frame alone
    int divider = 0;                           // column of the picture at which the right frame begins
    bool two_eyes = false;                     // both frames are seen whole, each in its half; there is no divider
    std::uint32_t background = 0x808080;       // RRGGBB
    std::optional<EyeDomeOptions> eye_dome{};  // none: colours as they are
    // In place of the frames' colours: R32UI as PackedPoint::rgba, 0 where no point is. Both or none.
    std::array<const Texture2D*, 2> packed{};
    // Lines over the sides, and the near plane of the frames' view.
    std::array<std::span<const WireEnd>, 2> wires{};
    double near = 1.0;
  };

  Display();

  // Fills the window with the scene, stretched where it has another size.
  void show(const Scene& scene, const glm::ivec2& window_size);
  // Fills the window with a colour.
  void clear(std::uint32_t background, const glm::ivec2& window_size);
  // The scene as show() shows it in a window of the left frame's size, or of both eyes'. Waits for the GPU.
  Image picture(const Scene& scene);

 private:
  void draw(const Scene& scene, const glm::ivec2& size, bool upside_down);
  // From this column of the framebuffer on; not of two eyes.
  void draw(const Scene& scene, const glm::ivec2& size, int first_column, bool upside_down);
  // Compiled when first used.
  const Program& program(bool split, bool packed);

  std::array<std::array<std::optional<Program>, 2>, 2> programs_;  // split, packed
  std::array<EyeDome, 2> eye_domes_;                               // of the sides
  WirePainter wire_painter_;
  Handle<gl_delete::vertex_array> no_vertices_;
};

}  // namespace stipple
