#include "src/viewer/reference_painter.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "render/reference/reference.h"
#include "src/viewer/window.h"

namespace stipple {

ReferencePainter::ReferencePainter() : thread_([this] { work(); }) {}

ReferencePainter::~ReferencePainter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ReferencePainter::ask(Subject subject) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(subject);
  }
  wake_.notify_one();
}

bool ReferencePainter::busy() const {
  const std::lock_guard lock(mutex_);
  return next_ || painting_ || painted_;
}

std::optional<ReferencePainter::Painted> ReferencePainter::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(painted_, std::nullopt);
}

void ReferencePainter::work() {
  tbb::task_arena arena(std::max(1, tbb::this_task_arena::max_concurrency() / 2));
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || next_; });
    if (stop_) return;
    Painted painted{*std::exchange(next_, std::nullopt), {}};
    painting_ = true;
    lock.unlock();
    const Subject& subject = painted.subject;
    painted.frame =
        arena.execute([&] { return render_reference(subject.dataset->points, subject.view, subject.point_size); });
    lock.lock();
    painting_ = false;
    painted_ = std::move(painted);
    Window::wake();
  }
}

}  // namespace stipple
