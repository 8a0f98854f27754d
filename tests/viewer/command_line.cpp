#include "src/viewer/command_line.h"

#include <gtest/gtest.h>

#include "src/viewer/describe_point.h"
#include "src/viewer/keys.h"

namespace stipple::test::viewer_command_line {
namespace {

TEST(CommandLine, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(quoted("/data/city-2.las"), "/data/city-2.las");
  EXPECT_EQ(quoted("my scan.las"), "'my scan.las'");
  EXPECT_EQ(quoted("it's.las"), "'it'\\''s.las'");
  EXPECT_EQ(quoted("$HOME;x"), "'$HOME;x'");
  EXPECT_EQ(quoted(""), "''");
}

TEST(CommandLine, SaysAllThatThePictureDependsOn) {
  const std::string text = text_of(RenderCommand{.inputs = {"a.las", "b c.las"},
                                                 .mode = "hybrid",
                                                 .raster = "compute",
                                                 .camera = {.eye = {-0.1, 2, 3}, .target = {637000.25, 5, 6}},
                                                 .size = {640, 480},
                                                 .colors = {.attribute = "point source id"},
                                                 .point_size = {2.0, 0.25},
                                                 .background = 0x0A0B0C});
  EXPECT_EQ(text,
            "stipple render a.las 'b c.las' -o view.png --mode hybrid --raster compute --size 640x480 --eye=-0.1,2,3 "
            "--target=637000.25,5,6 --up=0,0,1 --fov 60 --color 'point source id' --point-size 2 --background 0a0b0c "
            "--splat-size 0.25");
}

TEST(CommandLine, SaysHowFarApartTwoEyesAre) {
  RenderCommand command;
  command.size = {320, 480};
  command.eyes_apart = 0.065;
  const std::string text = text_of(command);
  EXPECT_NE(text.find(" --size 320x480 "), std::string::npos);
  EXPECT_TRUE(text.ends_with(" --stereo --eyes-apart 0.065")) << text;
}

TEST(ExactText, HasTheDecimalsOfTheGrid) {
  Grid grid{.offset = {500000.0, 5000000.0, 0.0}, .scale = {0.01, 0.001, 1.0}};
  const glm::ivec3 p{1234567, -1, 42};
  EXPECT_EQ(exact_text(grid, p, 0), "512345.67");
  EXPECT_EQ(exact_text(grid, p, 1), "4999999.999");
  EXPECT_EQ(exact_text(grid, p, 2), "42");
  grid.offset = {0.125, 0.0, 0.0};
  EXPECT_EQ(exact_text(grid, {1, 0, 0}, 0), "0.135");
  grid.scale.x = 1.0 / 3.0;
  EXPECT_EQ(exact_text(grid, {0, 0, 0}, 0), "0.125");
}

TEST(ExactText, GivesEveryIntegerOfAUtmGridBack) {
  const Grid grid{.offset = {400000.0, 5400000.0, 0.0}, .scale = glm::dvec3(0.001)};
  for (int i = -2'000'000'000; i < 2'000'000'000; i += 999'983) {
    const double written = std::stod(exact_text(grid, {i, i, i}, 1));
    EXPECT_EQ(std::llround((written - 5400000.0) / 0.001), i);
  }
}

TEST(Keys, EachIsShownAndMeansOneThing) {
  for (const KeyEntry& entry : key_table()) {
    EXPECT_EQ(*entry.keys == 0, *entry.what == 0);
    if (!entry.command) continue;
    if (entry.key != 0) {
      const InputEvent event{.kind = InputEvent::Kind::key, .code = entry.key, .modifiers = entry.control ? 2 : 0};
      EXPECT_EQ(command_of(event), entry.command) << entry.what;
    }
    if (entry.character != 0) {
      const InputEvent event{.kind = InputEvent::Kind::character, .code = entry.character};
      EXPECT_EQ(command_of(event), entry.command) << entry.what;
    }
  }
  EXPECT_EQ(command_of({.kind = InputEvent::Kind::character, .code = 'H'}), Command::home);
  EXPECT_FALSE(command_of({.kind = InputEvent::Kind::character, .code = 'z'}));
}

}  // namespace
}  // namespace stipple::test::viewer_command_line
