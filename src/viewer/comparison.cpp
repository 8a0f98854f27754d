#include "src/viewer/comparison.h"

#include <cmath>
#include <utility>

#include "render/measure/psnr.h"

namespace stipple {
namespace {

// Of shaders/difference.glsl.
constexpr int kLowBits = 12;
// Frames of a curve; later ones take the place of the last.
constexpr std::size_t kMostSamples = 2'000;

// Packed colours, 0 where no point is.
Texture2D texture_of(const FrameData& frame) {
  Texture2D texture(GL_R32UI, frame.size);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glTextureSubImage2D(texture.name(), 0, 0, 0, frame.size.x, frame.size.y, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      frame.rgba.data());
  return texture;
}

}  // namespace

std::string_view name_of(ReferenceComparison::Shown shown) {
  return shown == ReferenceComparison::Shown::picture      ? "picture"
         : shown == ReferenceComparison::Shown::difference ? "difference"
                                                           : "reference";
}

void ReferenceComparison::turn() {
  shown_ = shown_ == Shown::picture      ? Shown::difference
           : shown_ == Shown::difference ? Shown::reference
                                         : Shown::picture;
}

void ReferenceComparison::begin_view(double now) {
  view_start_ = now;
  for (Side& side : sides_) side.curve.clear();
}

void ReferenceComparison::rest(const ReferencePainter::Subject& subject) {
  asked_ = subject;
  painter_.ask(subject);
}

bool ReferenceComparison::take() {
  auto painted = painter_.take();
  if (!painted) return false;
  reference_ = texture_of(painted->frame);
  subject_ = std::move(painted->subject);
  for (Side& side : sides_) side.number = 0;
  return true;
}

const Texture2D* ReferenceComparison::reference_of(const View& view) const {
  return subject_ && subject_ == asked_ && subject_->view == view ? &reference_ : nullptr;
}

const Texture2D& ReferenceComparison::compare(std::size_t index, const FeedbackTarget& frame, std::uint64_t number,
                                              std::uint32_t background, double now) {
  Side& side = sides_[index];
  if (!program_) program_ = Program::compute("difference.glsl");
  if (side.colors.size() != frame.size()) side.colors = Texture2D(GL_R32UI, frame.size());
  sums_.fill(0);
  program_->use();
  frame.points().bind(0);
  frame.ids().bind(1);
  reference_.bind(2);
  side.colors.bind_image(0, GL_WRITE_ONLY);
  sums_.bind_storage(0);
  glUniform3i(0, static_cast<int>(background >> 16 & 0xFFu), static_cast<int>(background >> 8 & 0xFFu),
              static_cast<int>(background & 0xFFu));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (std::exchange(side.number, number) == number) return side.colors;

  std::array<std::uint32_t, 2> sums{};
  sums_.read(0, sums.data(), sizeof sums);
  const double pixels = static_cast<double>(frame.size().x) * frame.size().y;
  const double squares = sums[0] + std::ldexp(static_cast<double>(sums[1]), kLowBits);
  if (side.curve.size() == kMostSamples) side.curve.pop_back();
  side.curve.push_back({now - view_start_, psnr_db(squares / (3.0 * pixels))});
  return side.colors;
}

}  // namespace stipple
