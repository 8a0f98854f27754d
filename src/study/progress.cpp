#include "src/study/progress.h"

#include <fmt/format.h>

#include <cmath>

namespace stipple {

StudyProgress::StudyProgress(std::function<void(const std::string&)> show, std::size_t curves,
                             const std::atomic<bool>* interrupt)
    : show_(std::move(show)), curves_(curves), interrupt_(interrupt) {}

void StudyProgress::step(const std::string& what) const {
  check();
  show_(what);
}

std::string StudyProgress::left() const {
  if (done_ == 0) return "";
  const double seconds =
      watch_.seconds() / static_cast<double>(done_) * static_cast<double>(curves_ - left_out_ - done_);
  return seconds < 90.0 ? fmt::format(", about {:.0f} s left", std::ceil(seconds))
                        : fmt::format(", about {:.0f} min left", std::ceil(seconds / 60.0));
}

void StudyProgress::begin_curve(const std::string& what) {
  check();
  show_(fmt::format("[{}/{}] {}{}", left_out_ + done_ + 1, curves_, what, left()));
}

void StudyProgress::end_curve() {
  ++done_;
}

void StudyProgress::check() const {
  if (interrupt_ && interrupt_->load())
    throw Interrupted("interrupted; the same command with --resume goes on from the last finished curve");
}

}  // namespace stipple
