// The same cloud read from several formats gives the same picture, up to the rounding of their grids.
#include <fmt/format.h>

#include <algorithm>

#include "octree/build/stream/tree_builder.h"
#include "octree/read/las/las_writer.h"
#include "render/reference/reference.h"
#include "render/store/colorize.h"
#include "src/scene/scene.h"
#include "tests/measure/point_partners.h"
#include "tests/octree/node_files.h"

namespace stipple::test::measure_same_picture {
namespace {

using test::PointPartners;
using test::ScratchFolder;

// The arithmetic of places in pixels, not of grids.
constexpr double kPlaceError = 1e-5;

struct Place {
  glm::dvec2 pixel;
  double depth;
};

// By the definition of a View, in world coordinates: what is drawn is computed on the grid.
Place project(const View& view, const PointSet& set, std::size_t i) {
  const glm::dvec3 r = (set.grid.offset - view.eye) + set.grid.scale * glm::dvec3(set.points[i].position);
  const double depth = glm::dot(view.forward, r);
  return {{view.size.x / 2.0 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth),
           view.size.y / 2.0 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth)},
          depth};
}

// Whether the point is in the pixel; `margin` is added on all sides of it, in pixels.
bool is_inside(const Place& place, const glm::dvec2& pixel, double margin) {
  return glm::all(glm::greaterThanEqual(place.pixel, pixel - margin)) &&
         glm::all(glm::lessThanEqual(place.pixel, pixel + 1.0 + margin));
}

// A cloud and its picture.
struct Drawn {
  const PointSet& set;
  FrameData frame;

  Drawn(const PointSet& points, const View& view) : set(points), frame(render_reference(points, view)) {}
};

// Compares the pictures of two clouds whose points are partners.
class PictureComparison {
 public:
  PictureComparison(const View& view, const Drawn& a, const Drawn& b, const PointPartners& partners,
                    const glm::dvec3& rounding)
      : view_(view), a_(a), b_(b), partners_(partners), depth_rounding_(glm::dot(glm::abs(view.forward), rounding)) {}

  // Pixels that show no point which is there, in its colour, or different points that rounding does not explain.
  std::size_t wrong_pixels() const {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < a_.frame.pixels(); ++i) {
      const glm::dvec2 pixel(static_cast<int>(i) % view_.size.x, static_cast<int>(i) / view_.size.x);
      wrong += !is_honest(a_, i, pixel) || !is_honest(b_, i, pixel) ||
               !is_explained(a_.frame.ids[i], b_.frame.ids[i], pixel);
    }
    return wrong;
  }

 private:
  bool is_honest(const Drawn& drawn, std::size_t i, const glm::dvec2& pixel) const {
    const std::uint32_t id = drawn.frame.ids[i];
    if (id == kNoPoint) return drawn.frame.rgba[i] == 0;
    return drawn.frame.rgba[i] == drawn.set.points.at(id).rgba &&
           is_inside(project(view_, drawn.set, id), pixel, kPlaceError);
  }

  bool is_explained(std::uint32_t in_a, std::uint32_t in_b, const glm::dvec2& pixel) const {
    const bool same = in_a == kNoPoint ? in_b == kNoPoint : partners_.of_a()[in_a] == in_b;
    return same || crosses_border(in_a, in_b, pixel) || swaps_depth(in_a, in_b);
  }

  // The point that one picture shows is, in the other cloud, in another pixel.
  bool crosses_border(std::uint32_t in_a, std::uint32_t in_b, const glm::dvec2& pixel) const {
    return (in_a != kNoPoint && !is_inside(project(view_, b_.set, partners_.of_a()[in_a]), pixel, -kPlaceError)) ||
           (in_b != kNoPoint && !is_inside(project(view_, a_.set, partners_.of_b()[in_b]), pixel, -kPlaceError));
  }

  // Both clouds have both points in the pixel; each shows the nearer one, and which that is lies within the rounding.
  bool swaps_depth(std::uint32_t in_a, std::uint32_t in_b) const {
    if (in_a == kNoPoint || in_b == kNoPoint) return false;
    const double error = 1e-9 * project(view_, a_.set, in_a).depth;
    const double behind_a = project(view_, a_.set, partners_.of_b()[in_b]).depth - project(view_, a_.set, in_a).depth;
    const double behind_b = project(view_, b_.set, partners_.of_a()[in_a]).depth - project(view_, b_.set, in_b).depth;
    return behind_a >= -error && behind_b >= -error && behind_a + behind_b <= 2.0 * depth_rounding_ + error;
  }

  const View& view_;
  const Drawn& a_;
  const Drawn& b_;
  const PointPartners& partners_;
  const double depth_rounding_;
};

PointSet load_set(const std::string& path, const std::string& color) {
  return make_point_set(load_cloud(*open_source(path), attributes_for_color(color)), color);
}

// From above and aside, and from the opposite side near the ground; all of the cloud is in the picture.
std::vector<View> views_of(const PointSet& set) {
  const glm::dvec3 low = set.grid.world_from_grid(set.bounds.min), high = set.grid.world_from_grid(set.bounds.max);
  std::vector<View> views;
  for (const glm::dvec3 from : {glm::dvec3(0.5, -0.6, 0.7), glm::dvec3(-0.7, 0.6, 0.2)}) {
    Camera camera;
    camera.target = 0.5 * (low + high);
    camera.eye = camera.target + 1.1 * glm::distance(low, high) * glm::normalize(from);
    views.push_back(make_view(camera, {240, 240}, 1e-3 * glm::distance(low, high)));
  }
  return views;
}

// `steps_off`: of its grid, by which the writer of the others moved points beyond rounding.
void expect_same_pictures(const std::vector<std::string>& paths, const std::string& color, double steps_off = 0.0) {
  const PointSet first = load_set(paths.front(), color);
  for (std::size_t p = 1; p < paths.size(); ++p) {
    SCOPED_TRACE(paths[p] + " beside " + paths.front());
    const PointSet other = load_set(paths[p], color);
    ASSERT_EQ(first.size(), other.size());
    const glm::dvec3 rounding = test::rounding_between(first.grid, other.grid) + steps_off * other.grid.scale;
    const PointPartners partners(first, other, rounding);
    ASSERT_EQ(partners.without(), 0u);
    for (const View& view : views_of(first)) {
      const Drawn a(first, view), b(other, view);
      EXPECT_EQ(PictureComparison(view, a, b, partners, rounding).wrong_pixels(), 0u);
      EXPECT_GT(a.frame.covered_pixels(), std::min(a.frame.pixels() / 50, first.size() / 2));
    }
  }
}

TEST(SamePicture, OfTreesMadeByHand) {
  const ScratchFolder potree, ept, zstandard, brotli, flat, nested, objects;
  const test::TreeFiles tree = test::TreeFiles::usual();
  std::vector<std::string> paths{tree.write(potree), test::TreeFiles::usual("BROTLI").write(brotli)};
  paths.push_back(test::EptFiles{tree}.write(ept));
  paths.push_back(test::EptFiles{tree, "zstandard"}.write(zstandard));
  expect_same_pictures(paths, "intensity");
  // BIN nodes keep eight bits of a colour
  expect_same_pictures({potree.path(""), test::Potree1Files{tree, "1.4"}.write(flat),
                        test::Potree1Files{tree, "1.7"}.write(nested), test::Potree1Files{tree, "1.8"}.write(objects)},
                       "intensity");
}

TEST(SamePicture, OfASceneAsLasAndAsOurTrees) {
  const ScratchFolder folder;
  write_las(*make_scene("city", 60'000, 1), folder.path("city.las"));
  std::vector<std::string> paths{folder.path("city.las")};
  for (const auto encoding : {potree2::Encoding::uncompressed, potree2::Encoding::brotli}) {
    const auto sources = open_each({paths.front()});
    StreamOptions options;
    options.encoding = encoding;
    options.leaf_capacity = 5'000;
    BuildMonitor monitor;
    paths.push_back(folder.path(fmt::format("tree-{}", paths.size())));
    build_tree(sources, paths.back(), options, monitor);
  }
  expect_same_pictures(paths, "rgb");
}

TEST(SamePicture, IsNotFoundWhereAPixelIsWrong) {
  const ScratchFolder folder;
  const PointSet set = load_set(test::TreeFiles::usual().write(folder), "intensity");
  const glm::dvec3 rounding = test::rounding_between(set.grid, set.grid);
  const PointPartners partners(set, set, rounding);
  const View view = views_of(set).front();
  const Drawn right(set, view);
  const auto wrong_pixels = [&](const auto& spoil) {
    Drawn spoiled = right;
    const auto shown = std::ranges::find_if(right.frame.ids, [](std::uint32_t id) { return id != kNoPoint; });
    spoil(spoiled.frame, static_cast<std::size_t>(shown - right.frame.ids.begin()));
    return PictureComparison(view, right, spoiled, partners, rounding).wrong_pixels();
  };
  EXPECT_EQ(wrong_pixels([](FrameData&, std::size_t) {}), 0u);
  const auto erase = [](FrameData& frame, std::size_t i) {
    frame.ids[i] = kNoPoint;
    frame.rgba[i] = 0;
  };
  EXPECT_EQ(wrong_pixels(erase), 1u);
  EXPECT_EQ(wrong_pixels([](FrameData& frame, std::size_t i) { frame.rgba[i] ^= 1; }), 1u);
  EXPECT_EQ(wrong_pixels([](FrameData& frame, std::size_t i) { std::swap(frame.ids[i], frame.ids[i + 1]); }), 2u);
  EXPECT_EQ(wrong_pixels([](FrameData& frame, std::size_t i) { frame.ids[i] = (frame.ids[i] + 1) % 360; }), 1u);
}

TEST(SamePicture, APointThatMovedOrChangedHasNoPartner) {
  const ScratchFolder folder;
  const PointSet set = load_set(test::TreeFiles::usual().write(folder), "intensity");
  const glm::dvec3 half_step = 0.5 * set.grid.scale;
  PointSet other = set;
  EXPECT_EQ(PointPartners(set, other, half_step).without(), 0u);
  other.points[7].position.z += 1;
  other.points[9].rgba ^= 1;
  EXPECT_EQ(PointPartners(set, other, half_step).without(), 2u);
}

struct Twins {
  const char* name;
  const char* color;
  std::vector<const char*> paths;  // in the shared data
  double steps_off;
};

class SamePictureOfFiles : public testing::TestWithParam<Twins> {};

TEST_P(SamePictureOfFiles, IsShown) {
  const std::filesystem::path data = STIPPLE_SHARED_DATA;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not there";
  std::vector<std::string> paths;
  for (const char* path : GetParam().paths) paths.push_back((data / path).string());
  expect_same_pictures(paths, GetParam().color, GetParam().steps_off);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, SamePictureOfFiles,
    testing::Values(
        Twins{"Lion",
              "rgb",
              {"potree+potree/lion_takanawa_ept_bin", "potree+potree/lion_takanawa_ept_laz",
               "potree+potree/lion_takanawa_laz", "potree+potree/lion_takanawa.copc.laz"},
              0.0},
        // PotreeConverter 2 moves points by up to a step: it cuts off what it should round
        Twins{"LionConverted", "rgb", {"potree+potree/lion_takanawa_laz", "derived/potree2/lion-brotli"}, 1.0},
        Twins{"HuacayccanchaConverted",
              "rgb",
              {"healthinnovation+huacayccancha/index", "derived/potree2/huacayccancha-uncompressed"},
              1.0},
        Twins{"LoneStar", "intensity", {"PDAL+PDAL/copc/lone-star.copc.laz", "PDAL+PDAL/ept/lone-star-laszip"}, 0.0},
        Twins{"Autzen", "rgb", {"PDAL+PDAL/las/autzen_trim_7.las", "PDAL+PDAL/laz/autzen_trim.laz"}, 0.0},
        Twins{"AutzenBit",
              "rgb",
              {"PDAL+PDAL/las/1.2-with-color.las", "PDAL+PDAL/copc/1.2-with-color.copc.laz",
               "PDAL+PDAL/ept/1.2-with-color", "libLAS+libLAS/data/1.2-with-color.laz"},
              0.0},
        Twins{"Ellipsoid",
              "rgb",
              {"visgl+loaders.gl/modules/copc/test/data/ellipsoid.laz",
               "visgl+loaders.gl/modules/copc/test/data/ellipsoid-1.4.laz",
               "visgl+loaders.gl/modules/copc/test/data/ellipsoid.copc.laz"},
              0.0},
        Twins{"Ripple",
              "rgb",
              {"visgl+loaders.gl/cpp/Model3DTiler/test/resources/ripple.las",
               "visgl+loaders.gl/cpp/Model3DTiler/test/resources/ripple.laz",
               "visgl+loaders.gl/cpp/Model3DTiler/test/resources/ripple_bin.ply"},
              0.0}),
    [](const auto& twins) { return twins.param.name; });

}  // namespace
}  // namespace stipple::test::measure_same_picture
