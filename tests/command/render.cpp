// `stipple render` from end to end.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "render/measure/image.h"
#include "render/measure/psnr.h"
#include "tests/command/run_stipple.h"
#include "tests/measure/npy_reader.h"

namespace stipple::test::command_render {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kPoints = 20'000;
constexpr const char* kRasters[] = {"points", "compute"};

class RenderCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  Outcome render(const std::string& arguments) const {
    return run_stipple(folder_, "render " + city_ + " --size 160x90 -o " + path("out.png") + " " + arguments);
  }
  // Draws to the named picture and expects that to work.
  Image picture(const std::string& name, const std::string& arguments) const {
    const Outcome outcome =
        run_stipple(folder_, "render " + city_ + " --size 160x90 -o " + path(name) + " " + arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << ": " << outcome.err;
    return read_png(path(name));
  }
  void expect_wrong_usage(const std::string& arguments, const std::string& named) const {
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_TRUE(contains(outcome.err, named)) << arguments;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(path("out.png"))) << arguments;
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

  const ScratchFolder folder_;
  const std::string city_ = city_file(folder_, kPoints);
};

TEST_F(RenderCommand, EitherDensityEndsWithTheSamePicture) {
  const std::string hierarchical = "--mode hierarchical --budget 3k --stats " + path("s.json") + " --density ";
  const Image uniform = picture("uniform.png", hierarchical + "uniform");
  const Json stats = json_file(path("s.json"));
  EXPECT_EQ(picture("box-count.png", hierarchical + "box-count").rgb, uniform.rgb);
  EXPECT_EQ(stats.at("density"), "uniform");
  EXPECT_GT(stats.at("pixels_estimated"), json_file(path("s.json")).at("pixels_estimated"));
  expect_wrong_usage("--density dense", "--density");
}

TEST_F(RenderCommand, NearSplatsAreTheSamePictureInEveryMode) {
  const std::string near = "--splat-size 0.5 --camera " +
                           write("low.json", R"({"eye": [565300, 5934150, 12], "target": [565310, 5934300, 14]})") +
                           " ";
  const Image points = picture("points.png", near.substr(17) + "--mode brute-force");
  const Image all = picture("brute-force.png", near + "--mode brute-force");
  EXPECT_NE(all.rgb, points.rgb);
  EXPECT_GT(psnr_db(mean_squared_error(all, picture("reference.png", near + "--mode reference"))), 35.0);
  for (const std::string mode : {"hierarchical", "unstructured", "unstructured --carry index", "hybrid", "lod"})
    EXPECT_EQ(picture("drawn.png", near + "--budget 20k --stats " + path("s.json") + " --mode " + mode).rgb, all.rgb)
        << mode;
  const Json stats = json_file(path("s.json"));
  EXPECT_EQ(stats.at("splat_size"), 0.5);
  EXPECT_GT(stats.at("clusters_far").get<int>() + stats.at("clusters_across").get<int>(), 0);
  for (const char* size : {"0", "-1", "wide"}) expect_wrong_usage(std::string("--splat-size ") + size, "--splat-size");
}

TEST_F(RenderCommand, EveryModeAndRasterEndsWithTheSamePictureAndFullStats) {
  const Image reference = picture("reference.png", "--mode reference");
  for (const std::string raster : kRasters) {
    const Image all = picture("brute-force.png", "--mode brute-force --raster " + raster);
    EXPECT_GT(psnr_db(mean_squared_error(all, reference)), raster == "compute" ? 35.0 : 15.0);
    for (const std::string mode : {"brute-force", "hierarchical", "unstructured", "hybrid"}) {
      const std::string name = mode + "-" + raster;
      const Image drawn = picture(
          name + ".png", "--mode " + mode + " --raster " + raster + " --budget 3k --stats " + path("stats.json"));
      EXPECT_EQ(drawn.rgb, all.rgb) << name;
      const Json stats = json_file(path("stats.json"));
      for (const char* key : {"points_total", "points_drawn", "points_reprojected", "frames", "converged", "ms",
                              "covered_pixels", "nodes_visible", "nodes_occluded", "bytes_read", "gl_renderer",
                              "version", "seed", "budget", "points_hash", "machine", "view", "mode", "raster"})
        EXPECT_TRUE(stats.contains(key)) << name << " " << key;
      EXPECT_EQ(stats.at("mode"), mode);
      EXPECT_EQ(stats.at("raster"), raster);
      EXPECT_EQ(stats.at("points_total"), kPoints);
      EXPECT_EQ(stats.at("converged"), true);
      EXPECT_EQ(stats.at("frames").get<int>() > 1, mode != "brute-force") << name;
      EXPECT_EQ(stats.at("nodes_visible").get<int>() > 0, mode == "hierarchical" || mode == "hybrid") << name;
    }
  }
}

TEST_F(RenderCommand, DrawsWhileLoadingAndEndsLikeBruteForce) {
  for (const std::string color : {"rgb", "height"}) {
    const std::string common = " --color " + color + " --stats " + path("stats.json");
    // The camera that is proposed from the header, for both
    picture("first.png", "--mode unstructured --while-loading" + common);
    const Json view = json_file(path("stats.json")).at("view");
    Json camera{{"eye", view.at("eye")}, {"up", view.at("up")}, {"fov_deg", view.at("fov_deg")}};
    for (int axis = 0; axis < 3; ++axis)
      camera["target"][axis] = view.at("eye")[axis].get<double>() + view.at("forward")[axis].get<double>();
    const std::string same_view = " --camera " + write("camera.json", camera.dump());
    const Image all = picture("all.png", "--mode brute-force" + common + same_view);
    const Json hash = json_file(path("stats.json")).at("points_hash");
    for (const std::string mode : {"unstructured", "unstructured --carry index", "hybrid"}) {
      const Image drawn = picture("drawn.png", "--budget 3k --while-loading --mode " + mode + common + same_view);
      EXPECT_EQ(drawn.rgb, all.rgb) << mode << " " << color;
      const Json stats = json_file(path("stats.json"));
      const Json& loading = stats.at("while_loading");
      EXPECT_EQ(stats.at("points_hash"), hash);
      EXPECT_EQ(loading.at("points_loaded"), kPoints);
      EXPECT_LE(loading.at("first_points_ms"), loading.at("loaded_ms"));
      EXPECT_LE(loading.at("loaded_ms"), loading.at("converged_ms"));
      EXPECT_EQ(loading.at("frames").size(), stats.at("frames"));
      EXPECT_EQ(loading.at("frames").back().at("points_loaded"), kPoints);
      EXPECT_GE(loading.at("bytes_uploaded"), 16 * kPoints);
    }
  }
}

TEST_F(RenderCommand, DrawingWhileLoadingNamesWhatItCannotDo) {
  for (const char* mode : {"reference", "brute-force", "hierarchical", "lod", "subsample"})
    expect_wrong_usage(std::string("--while-loading --mode ") + mode, "--while-loading");
  auto bytes = LasFile{.points = 1'000}.bytes();
  bytes.resize(9'000);
  const std::string cut = folder_.write("cut.las", bytes);
  const Outcome outcome = run_stipple(folder_, "render " + cut + " --while-loading -o " + path("out.png"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "cut.las")) << outcome.err;
  EXPECT_FALSE(fs::exists(path("out.png")));
}

TEST_F(RenderCommand, HiddenClassesAreDrawnByNoMode) {
  const Image all = picture("all.png", "--color classification");
  const std::string hide = "--color classification --ramp turbo --hide-class 2,6 --stats " + path("stats.json ");
  const Image reference = picture("reference.png", hide + "--mode brute-force");
  EXPECT_NE(reference.rgb, all.rgb);
  EXPECT_EQ(json_file(path("stats.json")).at("hidden_classes"), (Json{2, 6}));
  EXPECT_EQ(json_file(path("stats.json")).at("ramp"), "turbo");
  const Image exact = picture("exact.png", hide + "--mode reference");
  EXPECT_GT(psnr_db(mean_squared_error(exact, reference)), 35.0);
  for (const std::string mode : {"unstructured", "hierarchical", "hybrid"})
    EXPECT_EQ(picture(mode + ".png", hide + "--budget 5k --mode " + mode).rgb, reference.rgb) << mode;
  // Whatever the colour, from memory or from disk
  const std::string tree = path("tree");
  ASSERT_EQ(run_stipple(folder_, "build " + city_ + " -o " + tree).code, 0);
  const auto of_tree = [&](const std::string& mode) {
    const std::string name = path("tree-" + mode + ".png");
    const Outcome outcome = run_stipple(
        folder_, "render " + tree + " -o " + name + " --size 320x180 --color height --hide-class 2,6 --mode " + mode);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_png(name);
  };
  const Image from_memory = of_tree("brute-force");
  EXPECT_EQ(of_tree("hybrid").rgb, from_memory.rgb);
  EXPECT_EQ(of_tree("hierarchical").rgb, from_memory.rgb);
  for (const char* wrong : {"--hide-class 256", "--hide-class ground", "--ramp rainbow"})
    EXPECT_EQ(run_stipple(folder_, "render " + city_ + " -o " + path("no.png ") + wrong).code, 2) << wrong;
}

TEST_F(RenderCommand, EyeDomeLightingIsSaidInTheStats) {
  const Image plain = picture("plain.png", "--stats " + path("plain.json"));
  const Image shaded = picture("shaded.png", "--edl --edl-strength 2 --stats " + path("shaded.json"));
  EXPECT_NE(shaded.rgb, plain.rgb);
  EXPECT_TRUE(json_file(path("plain.json")).at("edl").is_null());
  EXPECT_EQ(json_file(path("shaded.json")).at("edl").at("strength"), 2.0);
  for (const char* wrong : {"--edl --mode reference", "--edl-radius 2", "--edl --edl-strength none"})
    EXPECT_EQ(run_stipple(folder_, "render " + city_ + " -o " + path("no.png ") + wrong).code, 2) << wrong;
}

TEST_F(RenderCommand, CompareSaysInfForTwoConvergedModes) {
  picture("a.png", "--mode hierarchical --budget 5k");
  picture("b.png", "--mode unstructured --budget 7k --seed 99");
  const Outcome outcome = run_stipple(folder_, "compare " + path("a.png") + " " + path("b.png") + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("psnr_db"), "inf");
}

TEST_F(RenderCommand, UntilFrameOneDrawsOneBudget) {
  const Outcome outcome = render("--until frame:1 --budget 1k --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json stats = Json::parse(outcome.out);
  EXPECT_EQ(stats.at("frames"), 1);
  EXPECT_EQ(stats.at("points_drawn"), 1'000);
  EXPECT_EQ(stats.at("points_reprojected"), 0);
  EXPECT_EQ(stats.at("converged"), false);
}

TEST_F(RenderCommand, ACameraFileAndItsOptionsGiveTheSamePicture) {
  const std::string camera = write("camera.json", R"({"eye": [-50.5, -60, 70], "target": [40, 40.25, 0],
                                                      "up": [0, 0.1, 1], "fov_deg": 47.5})");
  const Image by_file = picture("a.png", "--camera " + camera);
  const Image by_options = picture("b.png", "--eye=-50.5,-60,70 --target 40,40.25,0 --up 0,0.1,1 --fov 47.5");
  EXPECT_EQ(by_file.rgb, by_options.rgb);
  EXPECT_NE(by_file.rgb, picture("c.png", "").rgb);
}

glm::dvec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

TEST_F(RenderCommand, PositionsAndDepthsAgreeWithEachOtherAndTheCamera) {
  picture("out.png",
          "--stats " + path("s.json") + " --position-out " + path("p.npy") + " --depth-out " + path("d.npy"));
  const Json stats = json_file(path("s.json"));
  const Json& view = stats.at("view");
  const glm::dvec3 eye = vector_of(view.at("eye"));
  const double cot = 1.0 / std::tan(glm::radians(view.at("fov_deg").get<double>()) / 2);
  const NpyFile position_file = read_npy(path("p.npy"));
  EXPECT_TRUE(contains(position_file.header, "'shape': (90, 160, 3,)"));
  EXPECT_TRUE(contains(read_npy(path("d.npy")).header, "'shape': (90, 160,)"));
  const auto positions = position_file.values<double>();
  const auto depths = read_npy(path("d.npy")).values<float>();
  ASSERT_EQ(depths.size(), 90u * 160u);
  ASSERT_EQ(positions.size(), 3 * depths.size());

  std::uint64_t covered = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const glm::dvec3 p(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    if (std::isinf(depths[i])) {
      EXPECT_TRUE(std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z)) << i;
      continue;
    }
    ++covered;
    const glm::dvec3 r = p - eye;
    const double depth = glm::dot(vector_of(view.at("forward")), r);
    EXPECT_NEAR(depths[i], depth, 1e-5 * depth);
    const double x = 80 * (1 + glm::dot(vector_of(view.at("right")), r) * cot * 90 / 160 / depth);
    const double y = 45 * (1 - glm::dot(vector_of(view.at("up")), r) * cot / depth);
    EXPECT_NEAR(x, static_cast<double>(i % 160) + 0.5, 0.501) << i;
    EXPECT_NEAR(y, static_cast<double>(i / 160) + 0.5, 0.501) << i;
  }
  EXPECT_EQ(stats.at("covered_pixels"), covered);
}

// The left half of the picture, or the right one.
Image half_of(const Image& both, int half) {
  Image one{{both.size.x / 2, both.size.y}, {}};
  const int row = 3 * one.size.x;
  for (int y = 0; y < one.size.y; ++y) {
    const auto begin = both.rgb.begin() + (2 * y + half) * row;
    one.rgb.insert(one.rgb.end(), begin, begin + row);
  }
  return one;
}

TEST_F(RenderCommand, StereoIsTheTwoEyesSideBySide) {
  const Image both = picture("both.png", "--stereo --eyes-apart 40 --mode hybrid --budget 3k --stats " +
                                             path("s.json") + " --depth-out " + path("d.npy"));
  ASSERT_EQ(both.size, glm::ivec2(320, 90));
  EXPECT_TRUE(contains(read_npy(path("d.npy")).header, "'shape': (90, 320,)"));
  const Json stats = json_file(path("s.json"));
  EXPECT_EQ(stats.at("views"), 2);
  const Json& stereo = stats.at("stereo");
  EXPECT_EQ(stereo.at("eyes_apart"), 40.0);
  const auto of_both = [&](const char* key) {
    return stereo.at("left").at(key).get<std::uint64_t>() + stereo.at("right").at(key).get<std::uint64_t>();
  };
  EXPECT_EQ(stats.at("points_reprojected"), of_both("points_reprojected"));
  EXPECT_EQ(stats.at("covered_pixels"), of_both("covered_pixels"));
  EXPECT_EQ(stats.at("points_in_views"),
            2 * stats.at("points_drawn").get<std::uint64_t>() + of_both("points_reprojected"));
  // Each as if it were alone
  const Json& view = stats.at("view");
  const glm::dvec3 left = vector_of(stereo.at("left").at("eye"));
  const glm::dvec3 right = vector_of(stereo.at("right").at("eye"));
  EXPECT_NEAR(glm::dot(right - left, vector_of(view.at("right"))), 40.0, 1e-6);
  Json camera{{"up", view.at("up")}, {"fov_deg", view.at("fov_deg")}};
  for (int half = 0; half < 2; ++half) {
    camera["eye"] = stereo.at(half == 0 ? "left" : "right").at("eye");
    for (int axis = 0; axis < 3; ++axis)
      camera["target"][axis] = camera["eye"][axis].get<double>() + 100.0 * view.at("forward")[axis].get<double>();
    const Image alone = picture("one.png", "--mode brute-force --camera " + write("eye.json", camera.dump()));
    EXPECT_GT(psnr_db(mean_squared_error(half_of(both, half), alone)), 50.0) << half;
    EXPECT_LT(psnr_db(mean_squared_error(half_of(both, 1 - half), alone)), 30.0) << half;
  }
}

TEST_F(RenderCommand, StereoIsTheSamePictureInEveryMode) {
  const std::string stereo = "--stereo --eye 565300,5934150,12 --target 565310,5934300,14 --stats " + path("s.json ");
  const Image all = picture("all.png", stereo + "--mode brute-force");
  EXPECT_EQ(json_file(path("s.json")).at("points_in_views"), 2 * kPoints);
  EXPECT_NEAR(json_file(path("s.json")).at("stereo").at("eyes_apart").get<double>(), std::hypot(10, 150, 2) / 30, 1e-9);
  EXPECT_GT(psnr_db(mean_squared_error(all, picture("reference.png", stereo + "--mode reference"))), 35.0);
  for (const std::string mode : {"hierarchical", "unstructured --carry index", "hybrid", "hybrid --while-loading"})
    EXPECT_EQ(picture("drawn.png", stereo + "--budget 3k --mode " + mode).rgb, all.rgb) << mode;
  const Image shaded = picture("edl.png", stereo + "--edl");
  EXPECT_EQ(shaded.size, all.size);
  EXPECT_NE(shaded.rgb, all.rgb);
  picture("mono.png", "--stats " + path("s.json"));
  EXPECT_EQ(json_file(path("s.json")).at("views"), 1);
  EXPECT_TRUE(json_file(path("s.json")).at("stereo").is_null());
}

TEST_F(RenderCommand, TwoPicturesWiderThanOneMayBeAreWrongUsage) {
  const Outcome outcome =
      run_stipple(folder_, "render " + city_ + " -o " + path("out.png") + " --stereo --size 8193x8");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "--stereo")) << outcome.err;
}

TEST_F(RenderCommand, BackgroundAndPointSizeAreSeen) {
  const Image small = picture("a.png", "--background 010203");
  const Image large = picture("b.png", "--background 010203 --point-size 3");
  const auto empty = [](const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      count += image.rgb[i] == 1 && image.rgb[i + 1] == 2 && image.rgb[i + 2] == 3;
    return count;
  };
  EXPECT_GT(empty(large), 0u);
  EXPECT_GT(empty(small), empty(large));
}

TEST_F(RenderCommand, SettingsTravelInThePicture) {
  picture("a.png", "--seed 77");
  EXPECT_TRUE(contains(text_of(path("a.png")), "\"seed\":77"));
}

TEST_F(RenderCommand, WrongUsageNamesTheOption) {
  expect_wrong_usage("--mode fastest", "--mode fastest");
  expect_wrong_usage("--raster crayons", "--raster crayons");
  expect_wrong_usage("--size 0x10", "--size");
  expect_wrong_usage("--size 20000x10", "--size");
  expect_wrong_usage("--eye 1,2,3", "--target");
  expect_wrong_usage("--target 1,2,3", "--eye");
  expect_wrong_usage("--eye 1,2,3 --target 1,2,3", "eye and target");
  expect_wrong_usage("--eye 1,2 --target 0,0,0", "--eye");
  expect_wrong_usage("--up 0,0,1", "--eye");
  expect_wrong_usage("--eye 1,2,3 --target 0,0,0 --fov 180", "field of view");
  expect_wrong_usage("--color colour", "--color colour");
  expect_wrong_usage("--budget 0", "--budget");
  expect_wrong_usage("--budget 5M", "--budget");
  expect_wrong_usage("--fps 20 --budget 1k", "--fps");
  expect_wrong_usage("--fps 0", "--fps");
  expect_wrong_usage("--mode unstructured --steer gpu", "--fps");
  expect_wrong_usage("--mode unstructured --fps 20 --steer gpus", "--steer gpus");
  expect_wrong_usage("--mode hybrid --fps 20 --steer gpu", "--mode unstructured");
  expect_wrong_usage("--point-size -1", "--point-size");
  expect_wrong_usage("--point-size 1e30", "point size 1e+30");
  expect_wrong_usage("--point-size 1e30 --raster points", "point size 1e+30");
  expect_wrong_usage("--background red", "--background");
  expect_wrong_usage("--until later", "--until");
  expect_wrong_usage("--until frame:0", "--until frame:");
  expect_wrong_usage("--until ms:-1", "--until ms:");
  expect_wrong_usage("--seed -1", "--seed");
  expect_wrong_usage("--eyes-apart 0.065", "--stereo");
  expect_wrong_usage("--stereo --eyes-apart 0", "--eyes-apart");
  expect_wrong_usage("--stereo --eyes-apart near", "--eyes-apart");
}

TEST_F(RenderCommand, ACameraFileWithSeveralViewsIsWrongUsage) {
  const std::string two = write("two.json", R"({"views": [{"eye": [0,0,9], "target": [0,0,0]},
                                                           {"eye": [9,0,0], "target": [0,0,0]}]})");
  expect_wrong_usage("--camera " + two, two);
  expect_wrong_usage("--camera " + two + " --eye 1,2,3 --target 0,0,0", "--camera");
}

TEST_F(RenderCommand, FailuresNameTheFileAndLeaveNoPicture) {
  const auto expect_failure = [&](const std::string& input, const std::string& output, const std::string& more,
                                  const std::string& named) {
    const Outcome outcome = run_stipple(folder_, "render " + input + " --size 16x9 -o " + output + " " + more);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("stipple: ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, named));
  };
  expect_failure(path("missing.las"), path("out.png"), "", path("missing.las"));
  expect_failure(write("text.las", "no points here"), path("out.png"), "", "at byte 0");
  expect_failure(city_, path("out.png"), "--camera " + write("bad.json", "{\"eye\": "), "bad.json: at byte");
  expect_failure(city_, path("out.png"), "--camera " + write("huge.json", R"({"eye": [1e999,0,0], "target": [0,0,0]})"),
                 "huge.json");
  EXPECT_FALSE(fs::exists(path("out.png")));
  expect_failure(city_, path("missing/out.png"), "", path("missing/out.png"));
  expect_failure(city_, path("out.png"), "--stats " + path("missing/s.json"), path("missing/s.json"));
  expect_failure(city_, path("out.png"), "--depth-out " + path("missing/d.npy"), path("missing/d.npy"));
  for (const std::string& name : folder_.names()) EXPECT_FALSE(contains(name, ".part-"));
}

TEST_F(RenderCommand, APathThatIsNoUtf8IsDrawnAllTheSame) {
  fs::copy_file(city_, path("\xE9t\xE9.las"));
  const Outcome outcome = run_stipple(
      folder_, "render " + path("\xE9t\xE9.las") + " --size 16x9 -o " + path("out.png") + " --stats " + path("s.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json_file(path("s.json")).at("points_total"), kPoints);
}

TEST_F(RenderCommand, AnEmptyCloudAndASinglePointAreDrawn) {
  for (const std::size_t points : {std::size_t{0}, std::size_t{1}}) {
    const std::string file = folder_.write("few.las", LasFile{.points = points}.bytes());
    for (const std::string mode : {"reference", "brute-force", "hierarchical", "unstructured", "hybrid"}) {
      const Outcome outcome =
          run_stipple(folder_, "render " + file + " --size 16x9 --json -o " + path("few.png") + " --mode " + mode);
      ASSERT_EQ(outcome.code, 0) << mode << ": " << outcome.err;
      const Json stats = Json::parse(outcome.out);
      EXPECT_EQ(stats.at("converged"), true) << mode;
      EXPECT_EQ(stats.at("covered_pixels"), points) << mode;
    }
  }
}

TEST_F(RenderCommand, HybridDoesWithoutWhatItIsTold) {
  const Image all = picture("all.png", "--mode hybrid --stats " + path("all.json"));
  EXPECT_EQ(picture("less.png", "--mode hybrid --no-skip occlusion,yield --stats " + path("less.json")).rgb, all.rgb);
  const Json more = json_file(path("all.json"));
  EXPECT_EQ(more.at("no_skip"), Json::array());
  EXPECT_GT(more.at("skipped").at("points_hidden"), 0);
  EXPECT_GT(more.at("attributes_not_read"), 5);
  const Json less = json_file(path("less.json"));
  EXPECT_EQ(less.at("no_skip"), Json({"occlusion", "yield"}));
  EXPECT_EQ(less.at("nodes_occluded"), 0);
  EXPECT_EQ(less.at("skipped").at("clusters_hidden"), 0);
  picture("more.png", "--mode hybrid --no-skip attributes,converged --until frame:40 --stats " + path("more.json"));
  EXPECT_EQ(json_file(path("more.json")).at("attributes_not_read"), 0);
  EXPECT_EQ(json_file(path("more.json")).at("frames"), 40);
  EXPECT_EQ(json_file(path("more.json")).at("converged"), true);
  expect_wrong_usage("--mode hybrid --no-skip everything", "--no-skip everything: expected one of frustum, occlusion");
}

TEST_F(RenderCommand, HybridLoadsATreeFromDisk) {
  const std::string tree = path("city.tree");
  ASSERT_EQ(run_stipple(folder_, "build " + city_ + " -o " + tree).code, 0);
  for (const std::string mode : {"hybrid", "hierarchical"})
    ASSERT_EQ(
        run_stipple(folder_, "render " + tree + " --size 160x90 -o " + path(mode + ".png") + " --mode " + mode).code,
        0);
  EXPECT_EQ(read_png(path("hybrid.png")).rgb, read_png(path("hierarchical.png")).rgb);
}

TEST_F(RenderCommand, HybridReadsOfATreeWhatIsNeededOrAllThatIsThere) {
  const std::string tree = path("city.tree");
  ASSERT_EQ(run_stipple(folder_, "build " + city_ + " -o " + tree).code, 0);
  const auto stats = [&](const std::string& no_skip) {
    const Outcome outcome =
        run_stipple(folder_, "render " + tree + " --size 160x90 --json -o " + path("tree.png") +
                                 " --eye 564900,5933900,200 " + "--target 565300,5934300,0 --fov 5" + no_skip);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  EXPECT_LT(stats("").at("points_read"), kPoints * 3 / 4);
  const Json all = stats(" --no-skip nodes");
  EXPECT_EQ(all.at("skipped").at("points_outside").get<std::uint64_t>() +
                all.at("skipped").at("points_hidden").get<std::uint64_t>() +
                all.at("points_drawn").get<std::uint64_t>(),
            kPoints);
}

TEST_F(RenderCommand, AFrameRateInsteadOfABudgetConvergesToo) {
  EXPECT_EQ(picture("a.png", "--fps 30").rgb, picture("b.png", "--budget 4M").rgb);
}

TEST_F(RenderCommand, TheGpuSteersToTheSamePicture) {
  const std::string view = " --eye 564900,5933900,200 --target 565300,5934300,0";
  for (const std::string raster : kRasters) {
    const std::string common = view + " --raster " + raster;
    const Image all = picture("all.png", "--mode brute-force" + common);
    for (const std::string more : {"", " --carry index", " --while-loading"}) {
      const std::string steered = "--mode unstructured --fps 200 --steer gpu --stats " + path("s.json") + more + common;
      EXPECT_EQ(picture("steered.png", steered).rgb, all.rgb) << raster << more;
      const Json stats = json_file(path("s.json"));
      EXPECT_EQ(stats.at("steered_by"), "gpu");
      EXPECT_GE(stats.at("points_drawn"), kPoints);
      EXPECT_TRUE(stats.at("converged"));
    }
  }
}

// The tree is ten times larger than both limits together, and ten times what drawing it adds to the process.
TEST_F(RenderCommand, ATreeTenTimesLargerThanItsMemoryIsDrawn) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own memory would count as the points'";
#endif
  const auto build = [&](std::uint64_t points, const std::string& name) {
    const std::string city = city_file(folder_, points, name + ".las");
    EXPECT_EQ(run_stipple(folder_, "build " + city + " -o " + folder_.path(name)).code, 0);
    return folder_.path(name);
  };
  const auto draw = [&](const std::string& tree, const std::string& options) {
    const std::string picture = tree + ".png";
    const Outcome outcome = run_stipple(
        folder_, "render " + tree + " -o " + picture + " --size 320x180 --mode hierarchical --json" + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const std::string limits = " --memory 4M --gpu-memory 2M";
  const std::string large = build(2'500'000, "large");
  ASSERT_GT(fs::file_size(large + "/octree.bin"), 10u * (6 << 20));
  const Json one = draw(build(1'000, "small"), limits);
  const Json limited = draw(large, limits);
  EXPECT_EQ(limited.at("converged"), true);
  EXPECT_LE(limited.at("budget").get<std::uint32_t>(), (2u << 20) / 40);
  EXPECT_LT(limited.at("peak_memory_bytes").get<double>() - one.at("peak_memory_bytes").get<double>(), 10 << 20);
  const std::string picture = text_of(large + ".png");
  draw(large, "");
  std::ofstream(folder_.path("limited.png"), std::ios::binary) << picture;
  const Outcome compared = run_stipple(folder_, "compare " + folder_.path("limited.png") + " " + large + ".png --json");
  EXPECT_EQ(Json::parse(compared.out).at("psnr_db"), "inf");
}

TEST_F(RenderCommand, WhatDoesNotFitIsRefusedBeforeItIsRead) {
  const std::string city = city_file(folder_, 10'000, "refused.las");
  const auto refused = [&](const std::string& options) {
    const Outcome outcome =
        run_stipple(folder_, "render " + city + " -o " + folder_.path("none.png") + " --size 64x36 " + options);
    EXPECT_EQ(outcome.code, 1) << options;
    EXPECT_FALSE(fs::exists(folder_.path("none.png")));
    return outcome.err;
  };
  EXPECT_TRUE(contains(refused("--memory 64k"), "--memory"));
  EXPECT_TRUE(contains(refused("--gpu-memory 64k"), "--gpu-memory"));
  EXPECT_EQ(run_stipple(folder_, "render " + city + " -o x.png --memory 1k").code, 2);
}

}  // namespace
}  // namespace stipple::test::command_render
