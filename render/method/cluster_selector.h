// Which clusters go on in a frame, and by how many points: decided on the GPU.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/frame/camera.h"
#include "render/frame/depth_pyramid.h"
#include "render/method/sighted_box.h"
#include "render/method/skips.h"
#include "render/store/cluster_table.h"

namespace stipple {

// Each call of select() tests against the frustum and the depth drawn so far, all clusters for a new view and later
// those that are open still; ranks those left by urgency; and takes as many points as the budget has, the most urgent
// first. What each asks for is the number of pixels it can cover. Clusters no point of which has been drawn come first,
// near ones before far ones, then those whose latest points won most pixels. Passes: shaders/clusters.glsl. The same
// budget takes the same points on any machine that computes the same floats. Two eyes have one selection: a cluster is
// left out only where neither may see it, and the yield of its points is that of both.
//
// Of what is selected, the CPU reads back the totals alone: it waits for the frames before.
class ClusterSelector {
 public:
  struct Options {
    std::uint32_t largest_budget;
    Skips skips{};
  };
  // Of one chunk.
  struct Taken {
    std::uint32_t first_place = 0;  // of places()
    std::uint32_t points = 0;
    std::uint32_t first_stretch = 0;
    std::uint32_t stretches = 0;
  };
  struct Result {
    std::vector<Taken> chunks;  // one for each of the cloud's
    std::uint32_t points = 0;
    std::uint32_t open = 0;      // clusters with points left
    std::uint32_t visible = 0;   // clusters in the frustum
    std::uint32_t occluded = 0;  // of them
  };

  // The table must outlive the selector, and may grow to its capacity meanwhile.
  ClusterSelector(const ClusterTable& table, const Options& options);

  // Has every pass run once, on a cloud of its own, and `frame` for each eye; forget() follows. See Method::warm_up().
  void warm_up(const View& view, const FeedbackTarget& frame);
  // No point was drawn ever.
  void forget();
  // Every point is to be drawn again, though clusters go on with the points that come next.
  void start_view(const View& view);
  // At most `budget` points. The block of the view's first eye is bound.
  Result select(const View& view, std::uint32_t budget);
  // The rows of these clusters are new: none of their points was drawn. They take part in the next select().
  void add(std::span<const ClusterRun> runs);
  // Those have no points any more, and are not open.
  void remove(std::span<const ClusterRun> runs);
  // How many clusters have points left for this view, those of add() included; unknown before its first select().
  std::optional<std::uint32_t> open() const { return selected_ ? std::optional(open_) : std::nullopt; }
  // Which they are; empty while unknown. Waits for the GPU.
  std::vector<std::uint32_t> open_clusters() const;
  // Which of these boxes are certainly hidden behind what is drawn in this view, or outside of it; sees_depth() must
  // hold. Waits for the GPU.
  std::vector<bool> hidden(std::span<const GridBox> boxes);
  // The clusters in sight. Waits for the GPU.
  std::vector<SightedBox> boxes() const;
  // Of this view so far. Waits for the GPU.
  SkipCounts skipped() const;
  // Whether hidden() can tell: something was drawn in this view.
  bool sees_depth() const;

  // The next select() adds to this frame of an eye, whose block is bound: tests against it, also the shards of clusters
  // that the last select() of this view took. The frame must stay as it is until then.
  void see(const FeedbackTarget& frame, std::size_t eye);
  // What select() chose is drawn, in this frame of an eye, whose block is bound: how much of it is seen.
  void learn_yield(const FeedbackTarget& frame);

  // Places in the chunks' buffers of the points taken.
  const GpuBuffer& places() const { return places_; }
  // Bytes of GPU memory it takes.
  static std::uint64_t bytes_for(std::uint64_t clusters, std::uint64_t budget);

 private:
  // A pass that compares with the depth drawn, from wherever the rasterizer keeps it.
  struct DepthTest {
    Program from_image;
    Program from_attachment;
  };
  // The passes that look at clusters from one eye, or from two.
  struct Looks {
    Program outline;
    DepthTest test;
  };
  struct Eye {
    DepthPyramid pyramid;
    const FeedbackTarget* drawn = nullptr;  // in this view; null: nothing yet
  };
  // The tables that a test reads and writes. Silhouettes of a second eye stand behind all of the first.
  struct Tested {
    const GpuBuffer& boxes;
    const GpuBuffer& log_pixels;
    const GpuBuffer& states;
    const GpuBuffer& sight;
    const GpuBuffer& silhouettes;
    const GpuBuffer& prospects;
    bool all;  // its rows from the first on; else the open clusters
    std::uint32_t capacity;
  };
  // Of up to kMostProbed boxes that are no clusters.
  struct Probe {
    GpuBuffer boxes, log_pixels, states, sight, silhouettes, prospects;
  };

  static DepthTest compile_depth_test(const char* shader, std::vector<ShaderDefine> defines);
  static Looks compile_looks(const std::vector<ShaderDefine>& defines);
  const Looks& looks() const { return eyes_open_ == 2 ? *looks_of_two_ : looks_of_one_; }
  void close_eyes();
  void outline(const Tested& tested, std::uint32_t first, std::uint32_t count);
  void test(const Tested& tested, std::uint32_t count);
  void test(const Tested& tested, std::uint32_t count, std::size_t eye);
  // Has this pass compare with what the eye has drawn.
  static void use(const DepthTest& pass, const Eye& eye);
  void test_shards(std::size_t eye);
  // Of all clusters, or of the first `count` open ones.
  void score(const View& view, std::uint32_t count, bool all);
  void rank(std::uint32_t budget);
  Result read_back();
  // Of those taken.
  std::uint32_t stretches() const { return taken_.empty() ? 0 : taken_.back().first_stretch + taken_.back().stretches; }

  const ClusterTable* table_;
  Options options_;
  std::vector<Eye> eyes_;          // as many as any view had
  std::size_t eyes_open_ = 1;      // of them, in this view
  glm::vec3 to_second_eye_{0.0f};  // from the first, world units
  std::uint32_t open_ = 0;         // clusters open after the last select(), and those added since
  std::uint32_t added_ = 0;        // of them, since
  bool selected_ = false;          // in this view
  bool seen_anew_ = false;         // see() was called since the last select()
  std::uint64_t view_points_ = 0;  // selected in this view
  std::uint64_t rounds_joined_ = 0;
  Looks looks_of_one_;
  std::optional<Looks> looks_of_two_;  // once a view had two eyes
  Program score_;
  Program cut_;
  Program sums_;
  Program scan_;
  Program take_;
  Program expand_;
  Program yield_;
  DepthTest test_shards_;
  GpuBuffer states_;
  GpuBuffer open_clusters_;  // after the last select(), and those added since, which may have replaced some of them
  GpuBuffer wishes_;
  GpuBuffer wishing_;
  GpuBuffer sight_;
  GpuBuffer summary_;
  GpuBuffer silhouettes_;
  GpuBuffer prospects_;
  GpuBuffer block_sums_;
  GpuBuffer stretches_;
  GpuBuffer places_;
  std::optional<Probe> probe_;
  std::vector<Taken> taken_;
};

}  // namespace stipple
