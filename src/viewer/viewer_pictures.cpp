// What leaves the window: pictures, settings, the command that renders the view.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "octree/core/error.h"
#include "src/cli/color_flags.h"
#include "src/cli/eye_dome_flags.h"
#include "src/run/provenance.h"
#include "src/viewer/command_line.h"
#include "src/viewer/viewer.h"

namespace stipple {

ViewerSettings Viewer::settings() const {
  return {.background = options_.background,
          .point_size = options_.point_size.pixels,
          .frames_per_second = options_.policy.frames_per_second.value_or(ViewerSettings{}.frames_per_second),
          .shaded = options_.shaded,
          .eye_dome = options_.eye_dome,
          .panel_shown = options_.panel_shown};
}

std::optional<EyeDomeOptions> Viewer::shading() const {
  return options_.shaded ? std::optional(options_.eye_dome) : std::nullopt;
}

View Viewer::view_of(const glm::ivec2& size) const {
  View view = rig_.view(eye_size(size));
  if (two_eyes_) view.eyes_apart = kUsualEyesApart * glm::distance(rig_.camera().eye, rig_.pivot());
  return view;
}

View Viewer::wanted_view() const {
  return !screenshot_.empty() && options_.screenshot_size ? view_of(*options_.screenshot_size) : view();
}

Display::Scene Viewer::scene(int width) const {
  Display::Scene scene{.left = stage_.frame(), .background = options_.background, .eye_dome = shading()};
  if (two_eyes_) {
    scene.right = stage_.frame(Stage::left, 1);
    scene.two_eyes = scene.right != nullptr;
  } else if (shows_both()) {
    scene.right = stage_.frame(Stage::right);
    scene.divider = divider_column(width);
  } else if (stage_.is_split() && shown_sides_ == Shown::right && stage_.frame(Stage::right)) {
    scene.left = stage_.frame(Stage::right);
  }
  scene.near = view().near;
  scene.wires = {wires_[Stage::left], wires_[Stage::right]};
  if (!two_eyes_ && scene.left == stage_.frame(Stage::right)) scene.wires[0] = wires_[Stage::right];
  if (!differences_[Stage::left]) return scene;
  scene.packed = {differences_[Stage::left], differences_[Stage::right]};
  if (scene.left == stage_.frame(Stage::right)) scene.packed[0] = differences_[Stage::right];
  if (comparison_.shown() == ReferenceComparison::Shown::reference) {
    scene.packed[0] = comparison_.reference_of(wanted_view());
    scene.right = nullptr;
  }
  return scene;
}

Image Viewer::picture() {
  if (stage_.frame()) return display_.picture(scene(stage_.frame()->size().x));
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
  if (screenshot_.empty() || !stage_.complete(wanted_view()) || workshop_.status().phase != WorkStatus::Phase::idle)
    return;
  if (comparison_.on() && (comparison_.busy() || compares_soon())) return;
  frames_to_show_ = kFramesAfterEvent;
  try {
    write_screenshot(screenshot_);
    const Unread unread = stage_.unread();
    note_ = fmt::format("{} written{}", screenshot_, unread.parts > 0 ? ", not complete" : "");
    if (unread.parts > 0 && options_.exit_after_screenshot) throw Error(unread.message());
  } catch (const Error& e) {
    if (options_.exit_after_screenshot) throw;
    note_ = e.what();
  }
  screenshot_.clear();
  options_.screenshot_size.reset();
  if (options_.exit_after_screenshot) quit_ = true;
}

void Viewer::write_screenshot(const std::string& path) {
  Json facts{{"mode", name_of(*stage_.pane().mode())},
             {"raster", name_of(options_.rasterizer)},
             {"point_size", options_.point_size.pixels},
             {"splat_size", options_.point_size.world},
             {"background", fmt::format("{:06x}", options_.background)},
             {"edl", json_of(shading())},
             {"shows", name_of(comparison_.shown())},
             {"frozen", stage_.frozen()},
             {"gl_renderer", window_.renderer()},
             {"gl_version", window_.version()}};
  facts.update(dataset_provenance(*stage_.dataset()));
  facts.update(color_provenance(stage_.dataset()->colors));
  facts["view"] = view_provenance(wanted_view());
  facts["eyes_apart"] = wanted_view().eyes_apart;
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
                                              .size = eye_size(),
                                              .eyes_apart = view().eyes_apart,
                                              .colors = dataset->colors,
                                              .point_size = options_.point_size,
                                              .background = options_.background,
                                              .shading = shading()}));
  note_ = "the command that renders this view is in the clipboard";
}

}  // namespace stipple
