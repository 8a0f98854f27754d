// How far what is drawn is from the reference: where, and how much, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"
#include "render/gpu/program.h"
#include "src/viewer/reference_painter.h"

namespace stipple {

class ReferenceComparison {
 public:
  enum class Shown { picture, difference, reference };
  // A frame and its error.
  struct Sample {
    double seconds;  // since the view began
    double psnr_db;  // against the reference; infinite where they are equal
  };
  using Curve = std::vector<Sample>;

  // The next of picture, difference, reference. From the first on there is a reference of each view that rests.
  void turn();
  void end() { shown_ = Shown::picture; }
  Shown shown() const { return shown_; }
  bool on() const { return shown_ != Shown::picture; }

  // A view begins, or begins anew, at this time of any clock.
  void begin_view(double now);
  bool asked_for(const ReferencePainter::Subject& subject) const { return asked_ == subject; }
  // Nothing moves, and this is to be compared.
  void rest(const ReferencePainter::Subject& subject);
  // What the painter has finished; true when there is a new reference.
  bool take();
  bool busy() const { return painter_.busy(); }
  // The reference of this view, to be shown: packed colours (R32UI), 0 where no point is. Null: not there yet.
  const Texture2D* reference_of(const View& view) const;

  // The difference, in such colours, of a frame that shows the reference's view; and its error goes to the side's
  // curve, once for each number of a frame. Waits for the GPU.
  const Texture2D& compare(std::size_t side, const FeedbackTarget& frame, std::uint64_t number,
                           std::uint32_t background, double now);
  const Curve& curve(std::size_t side) const { return sides_[side].curve; }

 private:
  struct Side {
    Texture2D colors;
    Curve curve;
    std::uint64_t number = 0;  // of the frame compared last
  };

  ReferencePainter painter_;
  Shown shown_ = Shown::picture;
  std::optional<ReferencePainter::Subject> asked_;
  std::optional<ReferencePainter::Subject> subject_;  // of the reference that is there
  Texture2D reference_;
  std::array<Side, 2> sides_;
  double view_start_ = 0.0;
  std::optional<Program> program_;
  GpuBuffer sums_{2 * sizeof(std::uint32_t)};
};

// "picture", "difference", "reference".
std::string_view name_of(ReferenceComparison::Shown shown);

}  // namespace stipple
