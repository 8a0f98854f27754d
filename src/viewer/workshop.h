// Loading, sorting and uploading in the background, so that the window never waits.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "octree/core/stopwatch.h"
#include "octree/store/tree_source.h"
#include "render/method/method.h"
#include "render/store/color_upload.h"
#include "render/store/colorist.h"
#include "render/store/dataset.h"
#include "src/viewer/watched_source.h"
#include "src/viewer/window.h"

namespace stipple {

// What to open.
struct Opening {
  std::vector<std::string> inputs;
  ColorChoice color;  // no attribute: the first there is
  Mode mode = Mode::hybrid;
  MethodOptions method;
  double aspect = 1.0;  // of the window: width over height
};

// What is being done just now.
struct WorkStatus {
  enum class Phase { idle, opening, reading, sorting, preparing, coloring };
  Phase phase = Phase::idle;
  std::uint64_t points = 0;  // read so far
  std::uint64_t total = 0;   // 0: not known
  double seconds = 0.0;      // since the phase began
};

// What the workshop has finished. In the order in which it comes.
namespace finished {
// A file without a tree is being read: these are its grid and what its header says.
struct Beginning {
  SourceInfo info;
};
struct Preview {
  PreviewPoints points;
};
// The cloud is open. Its points may be on disk still: then it comes again when they are in memory.
struct Cloud {
  std::shared_ptr<const Dataset> dataset;
  WorldBox box;  // where it is
  Camera home;   // sees all of it
};
// The points of the cloud have other colours, and nothing else is other.
struct Colors {
  std::shared_ptr<const Dataset> dataset;
  std::unique_ptr<ColorUpload> upload;  // of the same
};
// Ready to draw; it draws from `dataset`, which has to live as long.
struct MadeMethod {
  Mode mode;
  std::shared_ptr<const Dataset> dataset;
  std::unique_ptr<Method> method;
};
// What was asked for cannot be had.
struct Failure {
  std::string message;
  std::optional<Mode> mode;  // of a method that could not be made; else nothing could be opened
  bool cancelled = false;
  bool recoloring = false;  // it was other colours that were asked for
};
// All that is known of a point: name and value.
struct Description {
  std::uint32_t id;
  std::vector<std::pair<std::string, std::string>> values;
};
}  // namespace finished
using Finished = std::variant<finished::Beginning, finished::Preview, finished::Cloud, finished::Colors,
                              finished::MadeMethod, finished::Failure, finished::Description>;

// One thread with an OpenGL context of its own. All functions are for the window's thread.
class Workshop {
 public:
  explicit Workshop(const Window& window);
  // Waits for what cannot be stopped: sorting, uploading.
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  // Forgets what it had and what was asked for: from now on everything is about this.
  void open(const Opening& opening);
  // Gives the points of what is open, all of them in memory and no octree on disk, these colours. Ends a change of
  // colours that is not done.
  void recolor(const ColorChoice& color);
  // Other colours than those that take() gives next are asked for.
  bool will_recolor() const;
  // Makes the method for what is open, or about to be.
  void make(Mode mode);
  // Looks up the point with this id at this place.
  void describe(std::uint32_t id, const glm::ivec3& position);
  // Ends reading; what was asked for and is not done yet fails as cancelled.
  void cancel();

  // Idle: nothing is asked for that take() has not given.
  WorkStatus status() const;
  std::vector<Finished> take();

 private:
  using Task = std::function<void()>;
  void work();
  void run(const Task& task);
  void add(Task task);
  void deliver(Finished finished);
  void deliver_cloud(std::shared_ptr<const Dataset> dataset);
  void begin(WorkStatus::Phase phase);
  void open_now();
  void open_files();
  void open_octree();
  void read_all_points();
  void recolor_now();
  void change_colors(ColorChoice color);
  std::vector<Column> read_columns(const std::vector<std::string>& attributes);
  void make_now(Mode mode);
  void make_method_now(Mode mode);
  void describe_now(std::uint32_t id, const glm::ivec3& position);

  SharedContext context_;

  // The thread's own
  Opening opening_;
  std::shared_ptr<const Dataset> dataset_;
  Colorist colorist_;

  ReadWatch watch_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::deque<Task> tasks_;
  std::vector<Finished> finished_;
  std::optional<ColorChoice> color_;  // asked for, and a task waits for it
  bool recoloring_ = false;           // is what the thread is at
  std::uint64_t asked_ = 0;           // openings asked for
  std::uint64_t working_ = 0;         // that which the thread is at
  WorkStatus::Phase phase_ = WorkStatus::Phase::idle;
  Stopwatch phase_watch_;
  bool stop_ = false;

  std::thread thread_;  // last: it uses the others
};

}  // namespace stipple
