// What leaves the window: pictures, settings, the command that renders the view.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "octree/core/error.h"
#include "src/run/provenance.h"
#include "src/viewer/command_line.h"
#include "src/viewer/viewer.h"

namespace stipple {

ViewerSettings Viewer::settings() const {
  return {.background = options_.background,
          .point_size = options_.point_size,
          .frames_per_second = options_.policy.frames_per_second.value_or(ViewerSettings{}.frames_per_second),
          .panel_shown = options_.panel_shown};
}

Display::Scene Viewer::scene() const {
  Display::Scene scene{.left = stage_.frame(), .background = options_.background};
  if (shows_both()) {
    scene.right = stage_.frame(Stage::right);
    scene.divider = divider_column();
  } else if (stage_.is_split() && shown_sides_ == Shown::right && stage_.frame(Stage::right)) {
    scene.left = stage_.frame(Stage::right);
  }
  return scene;
}

Image Viewer::picture() {
  if (stage_.frame()) return display_.picture(scene());
  throw Error("there is nothing to picture yet");
}

Image Viewer::window_picture() const {
  Image image{size_, {}};
  const auto row = 3 * static_cast<std::size_t>(size_.x);
  image.rgb.resize(row * static_cast<std::size_t>(size_.y));
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // Rows count from the lower edge
  for (int y = 0; y < size_.y; ++y)
    glReadPixels(0, y, size_.x, 1, GL_RGB, GL_UNSIGNED_BYTE,
                 &image.rgb[row * static_cast<std::size_t>(size_.y - 1 - y)]);
  return image;
}

void Viewer::take_screenshot_if_due() {
  if (screenshot_.empty() || !stage_.complete(view()) || workshop_.status().phase != WorkStatus::Phase::idle) return;
  const std::string path = std::exchange(screenshot_, {});
  frames_to_show_ = kFramesAfterEvent;
  try {
    write_screenshot(path);
    note_ = fmt::format("{} written", path);
  } catch (const Error& e) {
    if (options_.exit_after_screenshot) throw;
    note_ = e.what();
  }
  if (options_.exit_after_screenshot) quit_ = true;
}

void Viewer::write_screenshot(const std::string& path) {
  Json facts{{"mode", name_of(*stage_.pane().mode())}, {"raster", name_of(options_.rasterizer)},
             {"point_size", options_.point_size},      {"background", fmt::format("{:06x}", options_.background)},
             {"gl_renderer", window_.renderer()},      {"gl_version", window_.version()}};
  facts.update(dataset_provenance(*stage_.dataset()));
  facts["view"] = view_provenance(view());
  facts.update(program_provenance());
  write_png(path, options_.with_panels ? window_picture() : picture(), {{"stipple", text_of(facts)}});
}

void Viewer::copy_command() {
  const Dataset* dataset = stage_.dataset();
  if (!dataset || !stage_.pane().mode()) return;
  window_.set_clipboard(text_of(RenderCommand{.inputs = options_.inputs,
                                              .mode = std::string(name_of(*stage_.pane().mode())),
                                              .raster = std::string(name_of(options_.rasterizer)),
                                              .camera = rig_.camera(),
                                              .size = size_,
                                              .color = dataset->colors.attribute,
                                              .point_size = options_.point_size,
                                              .background = options_.background}));
  note_ = "the command that renders this view is in the clipboard";
}

}  // namespace stipple
