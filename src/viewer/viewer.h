// The viewer: a window, a cloud, a camera, and the loop that ties them. viewer.cpp is that loop and what loading
// brings; viewer_events.cpp, viewer_commands.cpp, viewer_frames.cpp and viewer_pictures.cpp are what their names say.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "octree/core/stopwatch.h"
#include "render/frame/frame_parts.h"
#include "src/run/view_run.h"
#include "src/viewer/comparison.h"
#include "src/viewer/display.h"
#include "src/viewer/flight.h"
#include "src/viewer/gui.h"
#include "src/viewer/panel.h"
#include "src/viewer/pixel_reader.h"
#include "src/viewer/pointer.h"
#include "src/viewer/resolution.h"
#include "src/viewer/rig.h"
#include "src/viewer/settings.h"
#include "src/viewer/stage.h"
#include "src/viewer/tree_job.h"
#include "src/viewer/window.h"
#include "src/viewer/wires.h"
#include "src/viewer/workshop.h"

namespace stipple {

struct ViewerOptions {
  std::vector<std::string> inputs;  // may be none: files can be dropped
  ColorChoice color;
  std::optional<Mode> mode;  // none: hybrid
  MethodOptions method;
  RasterizerKind rasterizer = RasterizerKind::compute;
  BudgetPolicy policy;
  PointSize point_size;
  std::uint32_t background = 0x808080;
  bool shaded = false;  // by eye-dome lighting
  EyeDomeOptions eye_dome;
  std::optional<Camera> camera;    // to begin with; none: sees the whole cloud
  std::optional<CameraPath> path;  // to be flown on a key
  RecentInputs recent;
  bool panel_shown = true;
  std::string screenshot;                     // taken when nothing is left to draw; empty: none
  std::optional<glm::ivec2> screenshot_size;  // none: as large as the window is
  bool with_panels = false;                   // pictured as well
  bool exit_after_screenshot = false;
};

class Viewer {
 public:
  // `window` must outlive the viewer. Throws Error as loading shaders does.
  Viewer(Window& window, ViewerOptions options);

  // Waits for something to happen, at most `most_seconds`, and shows it. False when it is time to end. Throws Error
  // when a screenshot that it was to end after cannot be had.
  bool step(double most_seconds = 1.0);
  // Until the end.
  void run();

  void open(const std::vector<std::string>& inputs);
  void execute(Command command);
  // What is drawn, without panels.
  Image picture();
  // What is drawn, panels and all. Between drawing and swapping.
  Image window_picture() const;

  // As they are now.
  ViewerSettings settings() const;
  const RecentInputs& recent() const { return options_.recent; }

  // For tests and panels
  const Stage& stage() const { return stage_; }
  const Rig& rig() const { return rig_; }
  const std::vector<Pick>& picks() const { return picks_; }
  const std::optional<std::array<std::string, 3>>& under_cursor() const { return under_cursor_; }
  View view() const { return view_of(size_); }
  const TreeJob& tree_job() const { return tree_job_; }
  const std::string& built_tree() const { return built_tree_; }
  // Nothing moves, is loaded or left to draw.
  bool at_rest() const;
  // Pixels of the window that a pixel of the picture is wide and high while the camera moves.
  int resolution() const { return resolution_.divisor(); }
  bool shows_two_eyes() const { return two_eyes_; }
  // At which the right side begins.
  int divider_column() const { return divider_column(size_.x); }
  std::uint64_t frames_shown() const { return frames_shown_; }
  const ReferenceComparison& comparison() const { return comparison_; }
  const PointSize& point_size() const { return options_.point_size; }
  const std::string& note() const { return note_; }

 private:
  int divider_column(int width) const { return static_cast<int>(std::lround(divider_ * width)); }

  // Panels need a frame to learn of an event and one to lay themselves out.
  static constexpr int kFramesAfterEvent = 3;

  void take_finished();
  void take(const finished::Beginning& beginning);
  void take(const finished::Cloud& cloud);
  void take(const finished::Colors& colors);
  void take(const finished::Failure& failure);
  void take(const finished::Description& description);
  void enter(const WorldBox& box, const Camera& home);
  void color_by(const ColorChoice& color);
  void choose_shown_colors();

  void take_event(const InputEvent& event);
  void press(const InputEvent& event);
  void blink();
  void compare();
  void freeze();
  void look_with_two_eyes();
  bool shows_both() const;
  void follow(const Gesture& gesture);
  void fly();
  void face(double yaw_deg, double pitch_deg);
  void go_home();
  void next_color();
  void hide_class();
  void want_screenshot(const std::optional<glm::ivec2>& size);
  void build_tree_of_inputs();
  void take_tree();
  void record();
  void replay();
  void set_point_size(const PointSize& wanted);
  void larger_splats();
  void smaller_splats();

  void read_answers();
  void ask_under_cursor();
  glm::dvec3 world_of(const PickedPixel& pixel) const;
  std::array<std::string, 3> place_of(const PickedPixel& pixel) const;
  void pick(const PickedPixel& pixel);

  void show_frame();
  void draw_cloud(const Stopwatch& frame);
  void draw_rest(const View& view, std::uint64_t drawn, const Stopwatch& frame);
  void compare_frames();
  void lay_wires();
  std::optional<ReferencePainter::Subject> compared() const;
  bool compares_soon() const;
  void ask_for_reference();
  void notice_motion();
  bool moving() const;
  void learn_from(double ms, bool was_moving);
  // Of the window's size, what one eye has.
  glm::ivec2 eye_size() const { return eye_size(size_); }
  glm::ivec2 eye_size(const glm::ivec2& size) const;
  // In whose picture the place is.
  std::size_t eye_at(const glm::dvec2& place) const;
  // Where in its picture.
  glm::dvec2 place_of_eye(const glm::dvec2& place, std::size_t eye) const;
  void ask(PixelReader& reader, const glm::dvec2& place) const;
  void show_panels();
  void grant(const PanelWishes& wishes);
  void set_policy(const BudgetPolicy& policy);
  std::optional<EyeDomeOptions> shading() const;
  // Of a picture of this size; of two eyes each has half of it.
  View view_of(const glm::ivec2& size) const;
  // What is to be drawn: the window's view, or that of a screenshot of another size.
  View wanted_view() const;
  // Of a picture so many pixels wide.
  Display::Scene scene(int width) const;
  double cloud_target_ms() const;
  // Of the frame of this view that is drawn next.
  std::uint32_t first_budget(const View& view);
  void take_screenshot_if_due();
  void write_screenshot(const std::string& path);
  void copy_command();

  Window& window_;
  ViewerOptions options_;
  Gui gui_;
  Display display_;
  Workshop workshop_;
  Stage stage_;  // after the workshop, whose work it owns
  Rig rig_;
  Flight flight_;
  Pointer pointer_;
  double divider_ = 0.5;  // share of the width
  bool drags_divider_ = false;
  bool right_meant_ = false;  // by the key being looked at
  enum class Shown { both, left, right } shown_sides_ = Shown::both;
  bool two_eyes_ = false;        // and then there is one side
  std::size_t pressed_eye_ = 0;  // in whose picture the last button was pressed

  glm::ivec2 size_{1};    // of the last frame
  bool entered_ = false;  // the open cloud
  bool awaited_ = false;  // it is being read, and what its header says is in sight
  double spacing_ = 1.0;  // of its points, about, world units
  std::optional<Camera> home_;
  double home_aspect_ = 1.0;

  bool boxes_shown_ = false;
  std::array<std::vector<WireEnd>, 2> wires_;  // of the sides, or eyes, as they are shown
  std::array<std::size_t, 4> box_counts_{};    // of the left side, by state
  View frozen_view_;                           // when the stage was frozen
  double frozen_reach_ = 1.0;                  // how far its pyramid is drawn, world units
  ReferenceComparison comparison_;
  std::array<const Texture2D*, 2> differences_{};  // of the sides, where they are to be shown

  std::optional<FrameParts> parts_;
  double steered_pixels_ = 1.0;  // of the last frame
  double after_cloud_ms_ = 0.0;  // display and panels, of the last frame
  Resolution resolution_;
  Camera last_camera_;
  View drawn_view_;              // of the last frame
  double moved_at_ = -1.0;       // window seconds
  double frame_seconds_ = 0.0;   // smoothed, while frames follow each other
  double last_frame_ = 0.0;      // when
  std::vector<float> frame_ms_;  // of the latest frames that drew points
  int frames_to_show_ = 0;       // of panels that are not settled
  std::uint64_t frames_shown_ = 0;

  PixelReader hover_;
  PixelReader ahead_;
  PixelReader clicked_;
  bool clicked_for_pivot_ = false;
  glm::dvec2 cursor_{0.0};
  bool hover_stale_ = true;
  std::optional<PickedPixel> hovered_;
  std::optional<std::array<std::string, 3>> under_cursor_;
  std::optional<glm::dvec3> grabbed_;
  double flown_until_ = -1.0;  // window seconds; below 0: not flying
  std::vector<Pick> picks_;

  bool keys_shown_ = false;
  std::string note_;
  std::string screenshot_;  // due
  TreeJob tree_job_;
  std::string built_tree_;  // by it, the last time
  bool can_build_ = false;  // what is open is no tree
  bool quit_ = false;
};

}  // namespace stipple
