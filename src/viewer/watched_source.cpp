#include "src/viewer/watched_source.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <optional>

namespace stipple {

// An even sample by index. The colours' range is that of the first batch: whatever comes first decides.
class WatchedSource::Preview {
 public:
  Preview(const SourceInfo& info, ColorChoice choice, PreviewSink sink)
      : info_(info),
        choice_(std::move(choice)),
        sink_(std::move(sink)),
        step_(std::max<std::uint64_t>(1, (info.point_count + kPreviewPoints - 1) / kPreviewPoints)) {}

  void take(const PointBatch& batch) {
    Cloud sample;
    sample.info = info_;
    for (const Column& column : batch.columns) sample.columns.push_back({column.attribute, {}});
    PreviewPoints preview;
    for (std::size_t i = (step_ - batch.first % step_) % step_; i < batch.positions.size(); i += step_) {
      sample.positions.push_back(batch.positions[i]);
      preview.ids.push_back(static_cast<std::uint32_t>(batch.first + i));
      for (std::size_t c = 0; c < batch.columns.size(); ++c) append(batch.columns[c], i, sample.columns[c]);
    }
    if (preview.ids.empty()) return;
    const std::lock_guard lock(mutex_);
    // Threads that wait in map_colors() must not take another batch: they hold the lock
    if (!map_) tbb::this_task_arena::isolate([&] { map_ = choice_.complete(map_colors(sample, choice_.attribute)); });
    preview.colors = *map_;
    preview.points.resize(preview.ids.size());
    pack_points(*map_, sample.positions, sample.columns, 0, preview.points);
    sink_(std::move(preview));
  }

 private:
  static void append(const Column& column, std::size_t i, Column& to) {
    const std::size_t bytes = column.attribute.bytes();
    const std::size_t end = to.bytes.size();
    to.bytes.resize(end + bytes);
    std::memcpy(to.bytes.data() + end, column.bytes.data() + i * bytes, bytes);
  }

  const SourceInfo& info_;
  ColorChoice choice_;
  PreviewSink sink_;
  std::uint64_t step_;
  std::mutex mutex_;
  std::optional<ColorMap> map_;
};

WatchedSource::WatchedSource(const PointSource& source, ReadWatch& watch, ColorChoice choice, PreviewSink sink)
    : source_(source), watch_(watch) {
  watch_.points = 0;
  watch_.total = source.info().point_count;
  if (sink) preview_ = std::make_unique<Preview>(source.info(), std::move(choice), std::move(sink));
}

WatchedSource::~WatchedSource() = default;

void WatchedSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  source_.read(attributes, [&](const PointBatch& batch) {
    if (watch_.stop) throw Cancelled();
    if (preview_) preview_->take(batch);
    consume(batch);
    watch_.points += batch.positions.size();
  });
  if (watch_.stop) throw Cancelled();
}

}  // namespace stipple
