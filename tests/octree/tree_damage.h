// Octrees on disk with anything in their files.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <random>
#include <string>
#include <vector>

#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "src/check/check_tree.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test {

// Opens, reads and checks it all. Whether that went without an error, which has to name the path.
inline bool survives(const std::string& path) {
  try {
    check_tree(*open_tree(path));
    const auto source = open_source(path);
    std::vector<std::size_t> everything(source->info().schema.size());
    for (std::size_t i = 0; i < everything.size(); ++i) everything[i] = i;
    std::atomic<std::uint64_t> points{0};
    source->read(everything, [&](const PointBatch& batch) { points += batch.positions.size(); });
    EXPECT_EQ(points, source->info().point_count);
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), path));
    return false;
  }
  return true;
}

// The most memory that the process had so far.
inline std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Overwrites one to four places with random or telling values; sometimes cuts the rest off.
inline void damage(Bytes& bytes, std::mt19937& random) {
  constexpr std::uint8_t kTelling[] = {0x00, 0x01, 0x02, 0x7F, 0x80, 0xFF, '9', '"', '-', '}', ']'};
  const std::size_t places = 1 + random() % 4;
  for (std::size_t p = 0; p < places; ++p) {
    const std::size_t begin = random() % bytes.size();
    const std::size_t length = std::min<std::size_t>(std::size_t{1} << random() % 4, bytes.size() - begin);
    const bool telling = random() % 2 == 0;
    const std::uint8_t value = kTelling[random() % std::size(kTelling)];
    for (std::size_t b = 0; b < length; ++b)
      bytes[begin + b] = static_cast<std::byte>(telling ? value : static_cast<std::uint8_t>(random()));
  }
  if (random() % 16 == 0) bytes.resize(random() % bytes.size());
}

}  // namespace stipple::test
