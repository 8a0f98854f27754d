#include "tests/render/gl_test.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <random>

#include "render/frame/propose_views.h"
#include "render/gpu/context.h"
#include "render/method/brute_force.h"
#include "render/method/progressive_renderer.h"
#include "src/scene/scene.h"

namespace stipple::test {
namespace {

// One context for all tests; any error the driver reports ends the run.
class ContextEnvironment : public testing::Environment {
 public:
  void SetUp() override { context_ = std::make_unique<HeadlessContext>(ContextOptions{.errors_are_fatal = true}); }
  void TearDown() override { context_.reset(); }

 private:
  std::unique_ptr<HeadlessContext> context_;
};

const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new ContextEnvironment);

constexpr glm::ivec2 kMapSize{64, 18};

// '#' where a cell of the picture differs.
std::string difference_map(const std::vector<bool>& differs, const glm::ivec2& size) {
  std::string map;
  for (int row = 0; row < kMapSize.y; ++row) {
    for (int column = 0; column < kMapSize.x; ++column) {
      bool any = false;
      for (int y = row * size.y / kMapSize.y; y < (row + 1) * size.y / kMapSize.y; ++y)
        for (int x = column * size.x / kMapSize.x; x < (column + 1) * size.x / kMapSize.x; ++x)
          any = any || differs[static_cast<std::size_t>(y * size.x + x)];
      map += any ? '#' : '.';
    }
    map += '\n';
  }
  return map;
}

}  // namespace

const Dataset& scene(const std::string& name, std::uint64_t points) {
  static std::map<std::pair<std::string, std::uint64_t>, Dataset> made;
  auto& dataset = made[{name, points}];
  if (dataset.points.size() == 0) dataset = load_dataset(*make_scene(name, points, 1), "", {.octree = true});
  return dataset;
}

View view_of(const Dataset& dataset, const std::string& camera, const glm::ivec2& size) {
  for (const NamedCamera& named : propose_cameras(dataset.points, static_cast<double>(size.x) / size.y))
    if (named.name == camera) return make_view(named.camera, size, near_plane(dataset.points.grid));
  ADD_FAILURE() << "no camera " << camera;
  return {};
}

PointSet points_at(const std::vector<glm::ivec3>& positions) {
  PointSet set;
  set.grid.scale = glm::dvec3(0.001);
  std::uint32_t color = 0;
  for (const glm::ivec3& p : positions) {
    set.bounds.extend(p);
    set.points.push_back({p, 0xFF000000u | (++color * 2654435761u >> 8)});
  }
  return set;
}

PointSet random_points(std::size_t count, int extent, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cell(-extent, extent);
  std::vector<glm::ivec3> positions;
  for (std::size_t i = 0; i < count; ++i)
    positions.push_back(i % 10 == 9 ? positions[random() % i] : glm::ivec3(cell(random), cell(random), cell(random)));
  return points_at(positions);
}

View front_view(double distance, const glm::ivec2& size) {
  return make_view({.eye = {0, -distance, 0}, .target = {0, 0, 0}}, size, 0.001);
}

testing::AssertionResult same_picture(const FrameData& a, const FrameData& b) {
  if (a.size != b.size) return testing::AssertionFailure() << "sizes differ";
  std::vector<bool> differs(a.pixels());
  std::string listed;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    differs[i] =
        a.ids[i] != b.ids[i] || a.rgba[i] != b.rgba[i] || a.positions[i] != b.positions[i] || a.depth[i] != b.depth[i];
    if (!differs[i] || ++count > 5) continue;
    listed += fmt::format("  pixel {},{}: id {:x} / {:x}, rgba {:08x} / {:08x}, depth {} / {}\n",
                          i % static_cast<std::size_t>(a.size.x), i / static_cast<std::size_t>(a.size.x), a.ids[i],
                          b.ids[i], a.rgba[i], b.rgba[i], a.depth[i], b.depth[i]);
  }
  if (count == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << count << " pixels differ:\n" << listed << difference_map(differs, a.size);
}

FrameData brute_force_picture(const PointSet& points, RasterizerKind rasterizer, const View& view,
                              const PointSize& point_size) {
  BruteForce method(points);
  return converged_picture(method, rasterizer, points.grid, view, 1, point_size);
}

FrameData converged_picture(Method& method, RasterizerKind rasterizer, const Grid& grid, const View& view,
                            std::uint32_t budget, const PointSize& point_size) {
  ProgressiveRenderer renderer(method, rasterizer, grid, point_size);
  for (int frame = 0; !renderer.draw(view, budget).converged; ++frame)
    if (frame == 1'000'000) {
      ADD_FAILURE() << "does not converge";
      break;
    }
  return renderer.read();
}

}  // namespace stipple::test
