// A source that is watched while it is read, and can be told to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/core/error.h"
#include "render/frame/point_set.h"
#include "render/store/colorize.h"

namespace stipple {

// The user does not want it any more.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

struct ReadWatch {
  std::atomic<std::uint64_t> points{0};  // read so far
  std::atomic<std::uint64_t> total{0};
  std::atomic<bool> stop{false};
};

// Some points of a cloud that is being read, coloured and with the ids that they will have.
struct PreviewPoints {
  ColorMap colors;
  std::vector<PackedPoint> points;
  std::vector<std::uint32_t> ids;
};
using PreviewSink = std::function<void(PreviewPoints)>;

class WatchedSource final : public PointSource {
 public:
  // About as many points go to the sink.
  static constexpr std::uint64_t kPreviewPoints = 400'000;

  // All must outlive it. `sink` is called from several threads, one at a time; null: no preview. The
  // attribute of `choice` as choose_color() gives it.
  WatchedSource(const PointSource& source, ReadWatch& watch, ColorChoice choice, PreviewSink sink);
  ~WatchedSource() override;

  const SourceInfo& info() const override { return source_.info(); }
  // Throws Cancelled soon after watch.stop.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  class Preview;
  const PointSource& source_;
  ReadWatch& watch_;
  std::unique_ptr<Preview> preview_;
};

}  // namespace stipple
