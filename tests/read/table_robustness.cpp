// Files cut off or damaged: an Error or all the points, never a crash, never fewer points without a word.
#include <fmt/format.h>

#include <random>

#include "tests/read/read_fixture.h"

namespace stipple::test::read_table_robustness {
namespace {

struct Sample {
  std::string name;
  std::string content;
  std::size_t points;
  bool counted;  // the header states the number of points
};

std::vector<Sample> samples() {
  constexpr int kPoints = 40;
  Binary rows, big, lists, columns;
  std::string text, obj;
  for (int i = 0; i < kPoints; ++i) {
    const float v = 0.25f * static_cast<float>(i);
    rows.put(v).put(-v).put(1.f).put(static_cast<std::uint8_t>(i)).put(std::uint8_t{0}).put(std::uint8_t{9});
    big.put(std::uint8_t{3}).put(1).put(2).put(3);
    lists.put(v).put(static_cast<std::uint8_t>(i % 3));
    for (int k = 0; k < i % 3; ++k) lists.put(7);
    lists.put(v).put(v);
    text += fmt::format("{} {} {} {} 200 9\n", v, -v, 1.5, i);
    obj += fmt::format("v {} {} {}\nvn 0 0 1\n", v, -v, 1.5);
  }
  for (int i = 0; i < kPoints; ++i) big.put(0.25f * static_cast<float>(i)).put(1.f).put(2.f);
  std::string packed;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < kPoints; ++i) columns.put(static_cast<float>(axis * i));
  for (std::size_t at = 0; at < columns.bytes().size(); at += 32)
    packed += '\x1F' + columns.bytes().substr(at, 32);  // 480 bytes: 15 whole runs of literals
  const std::string count = std::to_string(kPoints);
  const std::string ply = " 1.0\ncomment a comment\nelement vertex " + count + "\nproperty float x\n";
  const std::string yz = "property float y\nproperty float z\n";
  const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const std::string pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
                          "\nHEIGHT 1\nPOINTS " + count + "\nDATA ";
  return {
      {"binary ply", "ply\nformat binary_little_endian" + ply + yz + rgb + "end_header\n" + rows.bytes(), kPoints,
       true},
      {"list ply",
       "ply\nformat binary_little_endian" + ply + "property list uchar int l\n" + yz + "end_header\n" + lists.bytes(),
       kPoints, true},
      {"ascii ply", "ply\nformat ascii" + ply + yz + rgb + "end_header\n" + text, kPoints, true},
      {"mesh ply",
       "ply\nformat binary_little_endian 1.0\nelement face " + count + "\nproperty list uchar int i\nelement vertex " +
           count + "\nproperty float x\n" + yz + "end_header\n" + big.bytes(),
       kPoints, true},
      {"compressed pcd",
       pcd + "binary_compressed\n" +
           Binary().put(static_cast<std::uint32_t>(packed.size())).put(static_cast<std::uint32_t>(480)).bytes() +
           packed,
       kPoints, true},
      {"binary pcd", pcd + "binary\n" + columns.bytes(), kPoints, true},
      {"ascii pcd",
       pcd + "ascii\n" +
           [&] {
             std::string lines;
             for (int i = 0; i < kPoints; ++i) lines += fmt::format("{} 0.5 nan\n", i);
             return lines;
           }(),
       kPoints, true},
      {"obj", "o thing\n" + obj, kPoints, false},
      {"xyz", text, kPoints, false},
      {"pts", count + "\n" + text, kPoints, true},
  };
}

using TableRobustness = TableFiles;

TEST_F(TableRobustness, AFileCutOffAnywhereIsAnErrorOrSaysSo) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const Cloud whole = load(sample.content);
    EXPECT_EQ(whole.size() + whole.info.dropped_points, sample.points);
    const std::size_t step = std::max<std::size_t>(1, sample.content.size() / 400);
    for (std::size_t size = 1; size < sample.content.size(); size += step) {
      const std::string cut = sample.content.substr(0, size);
      try {
        const Cloud cloud = load(cut);
        // Where nothing states the number of points, a cut behind a whole line cannot be told from a whole file
        const bool whole_line = !sample.counted && cut.back() == '\n';
        ASSERT_TRUE(whole_line || !cloud.info.warnings.empty()) << "cut at " << size;
        if (sample.counted && sample.name != "pts") {
          ASSERT_EQ(cloud.size() + cloud.info.dropped_points, sample.points) << "cut at " << size;
        }
      } catch (const Error& error) {
        ASSERT_TRUE(contains(error.what(), folder.path("cloud")));
      }
    }
  }
}

TEST_F(TableRobustness, ADamagedFileIsAnErrorOrReadWhole) {
  std::mt19937 random(4'712);
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (int i = 0; i < 600; ++i) {
      std::string bytes = sample.content;
      const std::size_t places = 1 + random() % 4;
      for (std::size_t p = 0; p < places; ++p) {
        const std::size_t reach = random() % 3 != 0 ? std::min<std::size_t>(bytes.size(), 200) : bytes.size();
        const char telling[] = "0123456789 -.\n\r,e#\xFF\x80\x7F";
        bytes[random() % reach] =
            random() % 2 == 0 ? telling[random() % (sizeof telling - 1)] : static_cast<char>(random());
      }
      try {
        const auto source = open(bytes);
        const Cloud cloud = load_all(*source);
        ASSERT_EQ(cloud.size(), source->info().point_count);
      } catch (const Error& error) {
        ASSERT_TRUE(contains(error.what(), folder.path("cloud")));
      }
    }
  }
}

}  // namespace
}  // namespace stipple::test::read_table_robustness
