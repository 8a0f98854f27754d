#include "render/frame/eye_dome.h"

namespace stipple {
namespace {

// Darkness for each halving of the distance at strength 1, as Potree scales it.
constexpr double kDarkness = 300.0;

}  // namespace

const Texture2D& EyeDome::shade(const FeedbackTarget& frame, const EyeDomeOptions& options) {
  const bool image = frame.depth_storage() == DepthStorage::image;
  std::optional<Program>& program = image ? from_image_ : from_attachment_;
  if (!program) program = Program::compute("eye_dome.glsl", {{image ? "FROM_IMAGE" : "FROM_ATTACHMENT"}});
  if (colors_.size() != frame.size()) colors_ = Texture2D(GL_R32UI, frame.size());
  program->use();
  frame.points().bind(0);
  frame.ids().bind(1);
  frame.depth().bind(2);
  colors_.bind_image(0, GL_WRITE_ONLY);
  glUniform1f(0, static_cast<float>(kDarkness * options.strength));
  glUniform1f(1, static_cast<float>(options.radius));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  return colors_;
}

std::vector<std::uint32_t> read_colors(const Texture2D& colors) {
  std::vector<std::uint32_t> rgba(static_cast<std::size_t>(colors.size().x) *
                                  static_cast<std::size_t>(colors.size().y));
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  read_texture(colors, GL_RED_INTEGER, GL_UNSIGNED_INT, sizeof(std::uint32_t), rgba.data());
  return rgba;
}

}  // namespace stipple
