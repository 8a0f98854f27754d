// The reference of a view, drawn in the background.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/frame/point_size.h"
#include "render/store/dataset.h"

namespace stipple {

// One thread, on half of the cores: the window's frames have the others.
class ReferencePainter {
 public:
  struct Subject {
    std::shared_ptr<const Dataset> dataset;  // all points in memory
    View view;
    PointSize point_size;

    bool operator==(const Subject&) const = default;
  };
  struct Painted {
    Subject subject;
    FrameData frame;
  };

  ReferencePainter();
  // Waits for a picture that has begun.
  ~ReferencePainter();
  ReferencePainter(const ReferencePainter&) = delete;
  ReferencePainter& operator=(const ReferencePainter&) = delete;

  // Draws this next. What was asked before and has not begun is forgotten.
  void ask(Subject subject);
  // Something is being drawn, or waits to be taken.
  bool busy() const;
  std::optional<Painted> take();

 private:
  void work();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Subject> next_;
  std::optional<Painted> painted_;
  bool painting_ = false;
  bool stop_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace stipple
