#include "src/report/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "render/measure/psnr.h"
#include "src/study/regime.h"

namespace stipple {
namespace {

namespace fs = std::filesystem;

// Bytes of PNG; base64 takes a third more.
constexpr std::uint64_t kComparedBytes = std::uint64_t{11} << 20;
constexpr std::uint64_t kFilmBytes = std::uint64_t{2} << 20;
constexpr std::size_t kFilmLength = 6;
constexpr int kFilmWidth = 240;  // pixels
// Averaged pixels have more to say, each: how much larger PNG files are then, a pixel.
constexpr double kShrunkenNoise = 1.3;

// A frame that was kept and what is known of it.
struct Frame {
  const CurvePoint* point;
  std::string file;
};

// Curves of one dataset, regime and view.
using Scene = std::vector<const Curve*>;

std::vector<Scene> scenes_of(std::span<const Curve> curves) {
  std::vector<Scene> scenes;
  for (const Curve& curve : curves) {
    if (curve.repeat != 0) continue;
    const auto same = [&](const Scene& scene) {
      const Curve& other = *scene.front();
      return other.dataset == curve.dataset && other.regime == curve.regime && other.view == curve.view;
    };
    const auto found = std::ranges::find_if(scenes, same);
    if (found == scenes.end())
      scenes.push_back({&curve});
    else
      found->push_back(&curve);
  }
  return scenes;
}

std::vector<Frame> kept_frames(const Curve& curve) {
  std::vector<Frame> frames;
  for (const KeptFrame& kept : curve.kept) {
    const auto is_kept = [&](const CurvePoint& point) { return point.state.frame == kept.frame; };
    if (const auto point = std::ranges::find_if(curve.points, is_kept); point != curve.points.end())
      frames.push_back({&*point, kept.file});
  }
  return frames;
}

// At most `count`, evenly, with the first and the last.
std::vector<Frame> thinned(const std::vector<Frame>& frames, std::size_t count) {
  if (frames.size() <= count) return frames;
  std::vector<Frame> few;
  for (std::size_t i = 0; i < count; ++i) few.push_back(frames[i * (frames.size() - 1) / (count - 1)]);
  return few;
}

// Those worth comparing with the reference, at most `count`: one is of the moment at which a tenth of the points were
// drawn, or the middle of a path.
std::vector<Frame> compared_frames(const Curve& curve, std::size_t count, std::uint64_t points_total) {
  if (curve.mode == "brute-force") return {};
  std::vector<Frame> frames = kept_frames(curve);
  const bool path = curve.regime == name_of(Regime::path);
  if (!path && frames.size() > 1) std::erase_if(frames, [](const Frame& frame) { return frame.point->identical; });
  if (count > 1 || frames.empty()) return thinned(frames, count);
  if (path) return {frames[frames.size() / 2]};
  const auto late = [&](const Frame& frame) { return 10 * frame.point->state.points_drawn >= points_total; };
  const auto found = std::ranges::find_if(frames, late);
  return {found == frames.end() ? frames.back() : *found};
}

std::string reference_file(const Curve& curve, std::uint64_t frame) {
  const std::string folder = fmt::format("reference/{}/{}", curve.dataset, curve.view);
  if (curve.regime == name_of(Regime::path)) return fmt::format("{}/{:05}.png", folder, frame);
  return folder;
}

std::string label_of(const Curve& curve, const CurvePoint& point) {
  const std::string work = fmt::format("{:.2f} M points", static_cast<double>(point.state.points_drawn) * 1e-6);
  return fmt::format("{}, frame {}: {}, {:.1f} dB", curve.mode, point.state.frame, work, psnr_db(point.mse));
}

class Builder {
 public:
  Builder(const fs::path& folder, std::span<const Curve> curves,
          const std::map<std::string, std::uint64_t>& points_total)
      : folder_(folder), scenes_(scenes_of(curves)), points_total_(points_total) {}

  ReportPictures build() {
    choose();
    for (const Scene& scene : scenes_) {
      const Curve& first = *scene.front();
      result_.scenes.push_back({{"dataset", first.dataset}, {"regime", first.regime}, {"view", first.view}});
      result_.scenes.back()["film"] = film(scene);
      result_.scenes.back()["pictures"] = compared(scene);
    }
    return std::move(result_);
  }

 private:
  // The reference pictures and frames of a scene, in the order of the list that a reader chooses from.
  struct Choice {
    const Curve* curve;  // null: the reference
    Frame frame;
  };

  std::vector<Choice> choices(const Scene& scene, std::size_t count) const {
    const Curve& first = *scene.front();
    const bool path = first.regime == name_of(Regime::path);
    std::map<std::uint64_t, std::vector<Choice>> by_frame;  // of a view, all under 0
    for (const Curve* curve : scene)
      for (const Frame& frame : compared_frames(*curve, count, points_total_.at(curve->dataset)))
        by_frame[path ? frame.point->state.frame : 0].push_back({curve, frame});
    std::vector<Choice> all;
    for (const auto& [frame, group] : by_frame) {
      all.push_back({nullptr, {group.front().frame.point, reference_of(first, frame)}});
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }

  // After a path a view is where that ends.
  std::string reference_of(const Curve& curve, std::uint64_t frame) const {
    const std::string file = reference_file(curve, frame);
    if (curve.regime != name_of(Regime::stop)) return file.ends_with(".png") ? file : file + ".png";
    fs::path last;
    for (const auto& entry : fs::directory_iterator(folder_ / file)) last = std::max(last, entry.path());
    return file + "/" + last.filename().string();
  }

  // As many frames as fit in whole; else fewer, else smaller ones.
  void choose() {
    struct Attempt {
      std::size_t frames;
      int scale;
    };
    for (const Attempt& attempt : {Attempt{6, 1}, {3, 1}, {1, 1}, {3, 2}, {1, 2}, {1, 3}, {1, 4}, {1, 6}, {1, 8}}) {
      frames_ = attempt.frames;
      result_.scale = attempt.scale;
      std::set<std::string> files;
      for (const Scene& scene : scenes_)
        for (const Choice& choice : choices(scene, frames_)) files.insert(choice.frame.file);
      double bytes = 0.0;
      for (const std::string& file : files) bytes += static_cast<double>(fs::file_size(folder_ / file));
      if (attempt.scale > 1) bytes *= kShrunkenNoise / (attempt.scale * attempt.scale);
      if (bytes <= static_cast<double>(kComparedBytes)) return;
    }
  }

  // The id of a file's picture at this scale.
  std::string add(const std::string& file, int scale) {
    const std::string id = fmt::format("{}@{}", file, scale);
    std::string& uri = result_.uris[id];
    if (!uri.empty()) return id;
    const Image image = read_png(folder_ / file);
    const int least = std::min(image.size.x, image.size.y);
    uri = data_uri(png_bytes(shrunk(image, std::min(scale, least))));
    return id;
  }

  Json compared(const Scene& scene) {
    Json pictures = Json::array();
    const bool path = scene.front()->regime == name_of(Regime::path);
    for (const auto& [curve, frame] : choices(scene, frames_)) {
      const std::uint64_t number = frame.point->state.frame;
      const std::string reference = path ? fmt::format("reference, frame {}", number) : "reference";
      pictures.push_back({{"id", add(frame.file, result_.scale)},
                          {"label", curve ? label_of(*curve, *frame.point) : reference},
                          {"mode", curve ? curve->mode : "reference"},
                          {"frame", curve || path ? number : 0}});
    }
    return pictures;
  }

  Json film(const Scene& scene) {
    Json frames = Json::array();
    for (const Curve* curve : scene) {
      for (const Frame& frame : thinned(kept_frames(*curve), kFilmLength)) {
        const FrameState& state = frame.point->state;
        if (film_bytes_ > kFilmBytes) return frames;
        const std::string id = add_small(frame.file);
        film_bytes_ += result_.uris[id].size() * 3 / 4;
        frames.push_back({{"id", id},
                          {"mode", curve->mode},
                          {"frame", state.frame},
                          {"points", state.points_drawn},
                          {"ms", curve->timed ? Json(state.milliseconds) : Json()},
                          {"psnr_db", json_of_any(psnr_db(frame.point->mse))}});
      }
    }
    return frames;
  }

  std::string add_small(const std::string& file) {
    if (film_scale_ == 0) film_scale_ = std::max(1, (read_png(folder_ / file).size.x + kFilmWidth - 1) / kFilmWidth);
    return add(file, film_scale_);
  }

  fs::path folder_;
  std::vector<Scene> scenes_;
  const std::map<std::string, std::uint64_t>& points_total_;
  std::size_t frames_ = 1;  // of a curve to compare
  int film_scale_ = 0;      // not known yet
  std::uint64_t film_bytes_ = 0;
  ReportPictures result_;
};

}  // namespace

Image shrunk(const Image& image, int k) {
  if (k == 1) return image;
  Image small{image.size / k, {}};
  small.rgb.resize(3 * static_cast<std::size_t>(small.size.x) * static_cast<std::size_t>(small.size.y));
  const auto width = static_cast<std::size_t>(image.size.x);
  const auto step = static_cast<std::size_t>(k);
  std::size_t out = 0;
  for (std::size_t y = 0; y < static_cast<std::size_t>(small.size.y); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(small.size.x); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        std::size_t sum = 0;
        for (std::size_t j = 0; j < step; ++j)
          for (std::size_t i = 0; i < step; ++i) sum += image.rgb[3 * ((y * step + j) * width + x * step + i) + c];
        small.rgb[out++] = static_cast<std::uint8_t>((sum + step * step / 2) / (step * step));
      }
  return small;
}

std::string data_uri(std::string_view png) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:image/png;base64,";
  uri.reserve(uri.size() + (png.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < png.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j)
      bits = bits << 8 | (i + j < png.size() ? static_cast<std::uint8_t>(png[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) uri += i + j <= png.size() ? kDigits[bits >> (18 - 6 * j) & 63u] : '=';
  }
  return uri;
}

ReportPictures report_pictures(const fs::path& folder, std::span<const Curve> curves,
                               const std::map<std::string, std::uint64_t>& points_total) {
  return Builder(folder, curves, points_total).build();
}

}  // namespace stipple
