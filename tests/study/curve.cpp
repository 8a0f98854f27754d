#include "src/study/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/measure/psnr.h"
#include "src/study/curve_json.h"
#include "src/study/summary.h"

namespace stipple::test::study_curve {
namespace {

double mse_of(double db) {
  return 255.0 * 255.0 / std::pow(10.0, db / 10.0);
}

// A curve whose frames have these decibels (infinite: equal to the reference) and draw 100 points in 10 ms each.
Curve curve_of(const std::vector<double>& decibels, double ms_scale = 1.0) {
  Curve curve{"city", "low", "unstructured", "compute", 0, {}};
  for (std::size_t i = 0; i < decibels.size(); ++i) {
    CurvePoint point;
    point.state.frame = i + 1;
    point.state.points_drawn = 100 * (i + 1);
    point.state.milliseconds = 10.0 * ms_scale * static_cast<double>(i + 1);
    point.state.budget = 100;
    point.mse = std::isinf(decibels[i]) ? 0.0 : mse_of(decibels[i]);
    curve.points.push_back(point);
  }
  return curve;
}

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Curve, ReachesAQualityAtItsFirstFrameThatHasIt) {
  const Curve curve = curve_of({20, 31, 29, 30.5, 41});
  EXPECT_EQ(reaches(curve, 30)->points_drawn, 200u);
  EXPECT_EQ(reaches(curve, 30)->milliseconds, 20.0);
  EXPECT_EQ(reaches(curve, 40)->points_drawn, 500u);
  EXPECT_FALSE(reaches(curve, 45).has_value());
  EXPECT_FALSE(reaches(Curve{}, 30).has_value());
}

TEST(Curve, AQualityMetExactlyIsReached) {
  Curve curve = curve_of({20});
  curve.points[0].mse = 65.025;  // 10 log10(65025 / 65.025) = 30 exactly
  EXPECT_TRUE(reaches(curve, psnr_db(65.025)).has_value());
}

TEST(Curve, EqualToTheReferenceReachesEveryQuality) {
  EXPECT_EQ(reaches(curve_of({20, kInf}), 1e6)->points_drawn, 200u);
}

TEST(Curve, IdenticalIsAboutBruteForceNotAboutDecibels) {
  Curve curve = curve_of({kInf, 40, 40});
  EXPECT_FALSE(reaches_identical(curve).has_value());
  curve.points[1].identical = true;
  EXPECT_EQ(reaches_identical(curve)->points_drawn, 200u);
}

TEST(Summary, GivesMedianAndSpreadOfTheTimes) {
  for (const std::size_t repeats : {1u, 3u, 4u}) {
    std::vector<Curve> curves;
    for (std::size_t r = 0; r < repeats; ++r)
      curves.push_back(curve_of({20, 35}, std::vector<double>{5.0, 1.0, 2.0, 4.0}[r]));
    const Json reached = summary_json(curves).at("reached").at("30_db");
    EXPECT_EQ(reached.at("points"), 200);
    EXPECT_EQ(reached.at("ms_median"), repeats == 1 ? 100.0 : repeats == 3 ? 40.0 : 60.0) << repeats;
    EXPECT_EQ(reached.at("ms_min"), repeats == 1 ? 100.0 : 20.0);
    EXPECT_EQ(reached.at("ms_max"), 100.0);
  }
}

TEST(Summary, AQualityThatNotAllRepeatsReachIsNull) {
  const std::vector<Curve> curves{curve_of({20, 35}), curve_of({20, 25})};
  const Json summary = summary_json(curves);
  EXPECT_TRUE(summary.at("reached").at("30_db").is_null());
  for (const char* key : {"30_db", "35_db", "40_db", "45_db", "identical"})
    EXPECT_TRUE(summary.at("reached").contains(key)) << key;
}

TEST(Summary, EndsWithTheLastFrame) {
  Curve curve = curve_of({20, kInf});
  curve.points.back().state.converged = true;
  curve.points.back().state.covered_pixels = 77;
  curve.points.back().identical = true;
  const Json summary = summary_json({&curve, 1});
  EXPECT_EQ(summary.at("frames"), 2);
  EXPECT_EQ(summary.at("points_drawn"), 200);
  EXPECT_EQ(summary.at("covered_pixels"), 77);
  EXPECT_EQ(summary.at("psnr_db"), "inf");
  EXPECT_EQ(summary.at("converged"), true);
  EXPECT_EQ(summary.at("identical_to_brute_force"), true);
}

TEST(Summary, GivesPercentilesOfTheFrameTimesOfAllRepeats) {
  std::vector<Curve> curves{curve_of(std::vector<double>(60, 20.0)), curve_of(std::vector<double>(40, 20.0))};
  // Two slow frames of a hundred, each with the sum before it
  for (std::size_t i = 30; i < 60; ++i) curves[0].points[i].state.milliseconds += 500.0;
  for (std::size_t i = 20; i < 40; ++i) curves[1].points[i].state.milliseconds += 90.0;
  const Json times = summary_json(curves).at("frame_ms");
  EXPECT_NEAR(times.at("p50").get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(times.at("p95").get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(times.at("p99").get<double>(), 100.0, 1e-9);
}

TEST(Summary, HasWhatWasMeasuredOfTheLastFrameAndAtEachQuality) {
  Curve curve = curve_of({20, 36});
  curve.points[1].ssim = 0.9;
  curve.points[1].flip = 0.1;
  curve.points[1].covered_mse = 65.025;
  curve.points[1].rates.hole = 0.25;
  const Json summary = summary_json({&curve, 1});
  EXPECT_EQ(summary.at("ssim"), 0.9);
  EXPECT_EQ(summary.at("flip"), 0.1);
  EXPECT_NEAR(summary.at("psnr_covered_db").get<double>(), 30.0, 1e-9);
  EXPECT_EQ(summary.at("hole"), 0.25);
  for (const char* key : {"see_through", "ghost", "wrong_point", "depth_error_mean", "depth_error_p95"})
    EXPECT_EQ(summary.at(key), 0.0) << key;
  EXPECT_EQ(summary.at("reached").at("35_db").at("flip"), 0.1);
  EXPECT_EQ(summary.at("reached").at("35_db").at("ssim"), 0.9);
  curve.points[1].flip.reset();
  EXPECT_TRUE(summary_json({&curve, 1}).at("flip").is_null());
}

TEST(Summary, CountsTheFramesThatTookLongerThanTheTarget) {
  Curve curve = curve_of(std::vector<double>(10, 20.0));
  curve.points.back().state.milliseconds += 15.0;
  const Json summary = summary_json({&curve, 1}, 12.0);
  EXPECT_EQ(summary.at("target_ms"), 12.0);
  EXPECT_NEAR(summary.at("frames_over_target").get<double>(), 0.1, 1e-12);
  EXPECT_TRUE(summary_json({&curve, 1}).at("frames_over_target").is_null());
}

TEST(Summary, HasNoTimesOfACurveThatWasNotTimed) {
  Curve curve = curve_of({20, 35});
  curve.timed = false;
  const Json summary = summary_json({&curve, 1}, 12.0);
  for (const char* key : {"frame_ms", "target_ms", "frames_over_target"}) EXPECT_TRUE(summary.at(key).is_null()) << key;
  EXPECT_EQ(summary.at("reached").at("30_db").at("points"), 200);
  EXPECT_TRUE(summary.at("reached").at("30_db").at("ms_median").is_null());
}

TEST(Summary, WeighsTheErrorOnTheWayByThePointsItTook) {
  Curve curve = curve_of({20, 30, 40});
  curve.points[2].state.points_drawn = 400;
  const auto area = [&](std::uint64_t total) {
    return summary_json({&curve, 1}, 0.0, total).at("area_db").get<double>();
  };
  EXPECT_NEAR(area(1000), psnr_db((100 * mse_of(20) + 100 * mse_of(30) + 800 * mse_of(40)) / 1000), 1e-9);
  EXPECT_NEAR(area(0), psnr_db((100 * mse_of(20) + 100 * mse_of(30) + 200 * mse_of(40)) / 400), 1e-9);
}

TEST(Summary, AveragesErrorsNotDecibels) {
  Curve curve = curve_of({kInf, 20});
  curve.points[1].parts.carry = 10.0;
  curve.points[1].flicker = 3.0;
  const Json mean = summary_json({&curve, 1}).at("mean");
  EXPECT_NEAR(mean.at("psnr_db").get<double>(), 20.0 + 10.0 * std::log10(2.0), 1e-9);
  EXPECT_EQ(mean.at("mse_carry"), 5.0);
  EXPECT_EQ(mean.at("flicker"), 3.0);  // of the one frame that has it
  EXPECT_TRUE(mean.at("ssim").is_null());
}

TEST(CurveJson, ComesBackToTheLastBit) {
  Curve curve = curve_of({20, 33.3, kInf});
  curve.regime = "jump";
  curve.timed = false;
  curve.kept = {{1, "frames/a.png"}, {3, "frames/b.png"}};
  CurvePoint& point = curve.points[1];
  point.state = {.frame = 2,
                 .milliseconds = 1.0 / 3.0,
                 .points_drawn = 1'234'567'890'123,
                 .points_reprojected = 7,
                 .covered_pixels = 8,
                 .budget = 9,
                 .converged = true};
  point.covered_mse = 0.1;
  point.ssim = 0.1234567890123456;
  point.flip = 0.2;
  point.rates = {.covered_pixels = 5,
                 .hole = 0.1,
                 .ghost = 0.2,
                 .see_through = 0.3,
                 .wrong_point = 0.4,
                 .depth_error_mean = 0.5,
                 .depth_error_p95 = 0.6};
  point.identical = true;
  point.parts = {.rounding = 0.7, .selection = 0.8, .carry = 0.9};
  point.reuse = 0.01;
  point.flicker = 0.02;
  const Curve back = curve_from(Json::parse(json_of(curve).dump()));
  EXPECT_EQ(curves_csv({&back, 1}), curves_csv({&curve, 1}));
  EXPECT_EQ(json_of(back), json_of(curve));
  EXPECT_EQ(back.points[1].state.milliseconds, point.state.milliseconds);
  EXPECT_EQ(back.points[1].ssim, point.ssim);
}

TEST(QualityMarks, AreTheFirstFrameAndTheFirstAtEachQuality) {
  QualityMarks marks;
  EXPECT_TRUE(marks.passes(10));
  EXPECT_FALSE(marks.passes(29.9));
  EXPECT_TRUE(marks.passes(30));
  EXPECT_FALSE(marks.passes(34));
  EXPECT_FALSE(marks.passes(28));
  EXPECT_FALSE(marks.passes(31));
  EXPECT_TRUE(marks.passes(41));
  EXPECT_FALSE(marks.passes(36));
  EXPECT_TRUE(marks.passes(kInf));
  EXPECT_FALSE(marks.passes(kInf));
}

TEST(CurvesCsv, HasALineAFrameBelowItsHeader) {
  Curve curve = curve_of({20, kInf});
  curve.points[1].identical = true;
  curve.points[1].state.converged = true;
  curve.points[1].state.covered_pixels = 9;
  curve.points[1].state.points_reprojected = 8;
  curve.points[1].state.points_loaded = 70;
  curve.points[0].covered_mse = 6502.5;
  curve.points[0].ssim = 0.75;
  curve.points[0].flip = 0.125;
  curve.points[0].rates = {.covered_pixels = 16,
                           .hole = 0.5,
                           .ghost = 0.0625,
                           .see_through = 0.25,
                           .wrong_point = 0.03125,
                           .depth_error_mean = 0.001,
                           .depth_error_p95 = 0.002};
  curve.points[0].parts = {.rounding = 0.25, .selection = 600.0, .carry = 50.0};
  curve.points[1].reuse = 0.5;
  curve.points[1].flicker = 1.5;
  const std::string header =
      "dataset,regime,view,mode,raster,repeat,frame,budget,points_drawn,points_reprojected,ms,V,R,S,covered_pixels,mse,"
      "psnr_db,psnr_covered_db,ssim,flip,hole,see_through,ghost,wrong_point,depth_error_mean,depth_error_p95,"
      "mse_rounding,mse_selection,mse_carry,reuse,flicker,points_loaded,identical,converged\n";
  EXPECT_EQ(curves_csv({&curve, 1}),
            header +
                "city,cold,low,unstructured,compute,0,1,100,100,0,10.000,1,0,100,0,650.25,20.000000,10.000000,0.750000,"
                "0.125000,0.500000,0.250000,0.062500,0.031250,0.001,0.002,0.25,600,50,,,,0,0\n"
                "city,cold,low,unstructured,compute,0,2,100,200,8,20.000,1,8,100,9,0,inf,inf,,,0.000000,0.000000,"
                "0.000000,0.000000,0,0,0,0,0,0.500000,1.500000,70,1,1\n");
}

TEST(CurvesCsv, HasNoTimeOfACurveThatWasNotTimed) {
  Curve curve = curve_of({20});
  curve.timed = false;
  EXPECT_NE(curves_csv({&curve, 1}).find("compute,0,1,100,100,0,,1,0,100,"), std::string::npos);
}

TEST(CurvesCsv, QuotesWhatWouldBreakALine) {
  Curve curve = curve_of({20});
  curve.dataset = "a,b";
  curve.view = "say \"hi\"";
  EXPECT_NE(curves_csv({&curve, 1}).find("\n\"a,b\",cold,\"say \"\"hi\"\"\",unstructured"), std::string::npos);
  curve.dataset = "two\nlines";
  curve.view = "carriage\rreturn";
  EXPECT_NE(curves_csv({&curve, 1}).find("\n\"two\nlines\",cold,\"carriage\rreturn\",unstructured"), std::string::npos);
}

}  // namespace
}  // namespace stipple::test::study_curve
