#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "octree/core/error.h"
#include "render/measure/image.h"

namespace stipple::test::measure_png {
namespace {

namespace fs = std::filesystem;

class Png : public testing::Test {
 protected:
  Png() { fs::create_directories(folder_); }
  ~Png() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("stipple-png-" + std::to_string(::getpid()));
};

Image noise(const glm::ivec2& size) {
  Image image{size, std::vector<std::uint8_t>(static_cast<std::size_t>(size.x * size.y) * 3)};
  std::mt19937 random(1);
  for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(random());
  return image;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// A PNG of one row with raw samples as given, for kinds of PNG that write_png does not make.
void write_row(const std::string& path, int width, int depth, int color, std::vector<std::uint8_t> row,
               const std::vector<png_color>& palette = {}) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), 1, depth, color, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  png_write_info(png, info);
  png_write_row(png, row.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

ImageText text_of(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_info(png, info);
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  ImageText out;
  for (int i = 0; i < count; ++i) out[texts[i].key] = texts[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return out;
}

using Bytes = std::vector<std::uint8_t>;

TEST_F(Png, ComesBackAsWritten) {
  for (const glm::ivec2 size : {glm::ivec2{1, 1}, {3, 5}, {640, 31}}) {
    write_png(path("a.png"), noise(size));
    const Image read = read_png(path("a.png"));
    EXPECT_EQ(read.size, size);
    EXPECT_EQ(read.rgb, noise(size).rgb);
  }
}

TEST_F(Png, CarriesText) {
  const ImageText text{{"Software", "stipple 0.1.0"}, {"Camera", "eye 1,2,3"}, {"Source", "Möbius.las"}, {"Empty", ""}};
  write_png(path("a.png"), noise({4, 4}), text);
  EXPECT_EQ(text_of(path("a.png")), text);
  EXPECT_EQ(read_png(path("a.png")).rgb, noise({4, 4}).rgb);
}

TEST_F(Png, OfAnyKindBecomesRgb) {
  write_row(path("grey.png"), 2, 8, PNG_COLOR_TYPE_GRAY, {7, 200});
  EXPECT_EQ(read_png(path("grey.png")).rgb, (Bytes{7, 7, 7, 200, 200, 200}));
  write_row(path("bits.png"), 3, 1, PNG_COLOR_TYPE_GRAY, {0b10100000});
  EXPECT_EQ(read_png(path("bits.png")).rgb, (Bytes{255, 255, 255, 0, 0, 0, 255, 255, 255}));
  write_row(path("alpha.png"), 2, 8, PNG_COLOR_TYPE_RGB_ALPHA, {1, 2, 3, 0, 4, 5, 6, 128});
  EXPECT_EQ(read_png(path("alpha.png")).rgb, (Bytes{1, 2, 3, 4, 5, 6}));
  write_row(path("grey_alpha.png"), 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {9, 50});
  EXPECT_EQ(read_png(path("grey_alpha.png")).rgb, (Bytes{9, 9, 9}));
  write_row(path("palette.png"), 2, 8, PNG_COLOR_TYPE_PALETTE, {1, 0}, {{10, 20, 30}, {40, 50, 60}});
  EXPECT_EQ(read_png(path("palette.png")).rgb, (Bytes{40, 50, 60, 10, 20, 30}));
}

TEST_F(Png, SixteenBitsAreRoundedToEight) {
  write_row(path("rgb16.png"), 1, 16, PNG_COLOR_TYPE_RGB, {0x12, 0x34, 0xFF, 0xFF, 0x7F, 0xFF});
  EXPECT_EQ(read_png(path("rgb16.png")).rgb, (Bytes{0x12, 255, 127}));
  write_row(path("rgba16.png"), 1, 16, PNG_COLOR_TYPE_RGB_ALPHA, {0x80, 0x80, 0, 0, 1, 1, 0, 0});
  EXPECT_EQ(read_png(path("rgba16.png")).rgb, (Bytes{0x80, 0, 1}));
}

TEST_F(Png, CutOffAnywhereIsAnErrorThatNamesTheFile) {
  write_png(path("whole.png"), noise({9, 6}), {{"Software", "stipple"}});
  const std::string whole = bytes_of(path("whole.png"));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_bytes(path("cut.png"), whole.substr(0, length));
    try {
      read_png(path("cut.png"));
      ADD_FAILURE() << length << " of " << whole.size() << " bytes were read without an error";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(path("cut.png")), std::string::npos) << e.what();
    }
  }
}

TEST_F(Png, DamagedBytesNeverCrash) {
  write_png(path("whole.png"), noise({9, 6}));
  const std::string whole = bytes_of(path("whole.png"));
  std::mt19937 random(2);
  for (int round = 0; round < 500; ++round) {
    std::string damaged = whole;
    for (int flips = 0; flips < 3; ++flips) damaged[random() % damaged.size()] = static_cast<char>(random());
    write_bytes(path("damaged.png"), damaged);
    try {
      const Image image = read_png(path("damaged.png"));
      EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y) * 3);
    } catch (const Error&) {
    }
  }
}

TEST_F(Png, OtherFilesAndMissingOnesAreErrors) {
  write_bytes(path("text.png"), "this is no picture at all");
  EXPECT_THROW(read_png(path("text.png")), Error);
  EXPECT_THROW(read_png(path("missing.png")), Error);
  EXPECT_THROW(read_png(path(".")), Error);
}

TEST_F(Png, FailedWriteLeavesTheOldFileAndNothingElse) {
  write_png(path("a.png"), noise({2, 2}));
  const std::string before = bytes_of(path("a.png"));
  EXPECT_THROW(write_png(path("a.png"), noise({3, 3}), {{"", "libpng refuses an empty keyword"}}), Error);
  EXPECT_EQ(bytes_of(path("a.png")), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(path(".")), {}), 1);
  EXPECT_THROW(write_png(path("no/such/folder/a.png"), noise({2, 2})), Error);
}

TEST_F(Png, FullDiskIsAnErrorAndTheDeviceStaysADevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  EXPECT_THROW(write_png("/dev/full", noise({200, 200})), Error);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Compose, PutsBackgroundWhereThereIsNoPoint) {
  FrameData frame = empty_frame({2, 1});
  frame.ids[1] = 0;
  frame.rgba[1] = 0xFF030201u;
  EXPECT_EQ(frame.covered_pixels(), 1u);
  EXPECT_EQ(compose(frame, 0x102030).rgb, (Bytes{0x10, 0x20, 0x30, 1, 2, 3}));
}

}  // namespace
}  // namespace stipple::test::measure_png
