// How far a study is, and whether it is to go on.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "octree/core/error.h"
#include "octree/core/stopwatch.h"

namespace stipple {

// Thrown where a study is asked to end; what it has finished is written.
class Interrupted : public Error {
 public:
  using Error::Error;
};

// Counts curves, all taken as equally long. Not for several threads, but for the flag that interrupts.
class StudyProgress {
 public:
  // `show` gets a line for every step; `interrupt`, where given, is looked at between frames and must outlive this.
  StudyProgress(std::function<void(const std::string&)> show, std::size_t curves, const std::atomic<bool>* interrupt);

  // A step that is no curve.
  void step(const std::string& what) const;
  // The next curve begins: "[3/24] WHAT, 40 s left".
  void begin_curve(const std::string& what);
  void end_curve();
  // Curves that will not be drawn: finished before, or impossible.
  void leave_out(std::size_t curves) { left_out_ += curves; }

  // Throws Interrupted where the flag is up.
  void check() const;

 private:
  std::string left() const;

  std::function<void(const std::string&)> show_;
  std::size_t curves_;
  const std::atomic<bool>* interrupt_;
  std::size_t left_out_ = 0;
  std::size_t done_ = 0;
  Stopwatch watch_;
};

}  // namespace stipple
