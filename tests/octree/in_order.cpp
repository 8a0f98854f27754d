// Work on all cores whose results are taken in order.
#include "octree/build/stream/in_order.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace stipple::test::octree_in_order {
namespace {

TEST(InOrder, PlacesEveryItemInOrderAndFinishesItOnce) {
  constexpr std::size_t kItems = 2'000;
  std::vector<std::size_t> placed;  // without a lock: one at a time is the promise
  std::vector<std::atomic<int>> finished(kItems);
  in_order<std::size_t>(
      kItems, 5,
      [](std::size_t index) {
        if (index % 37 == 0) std::this_thread::yield();
        return std::make_unique<std::size_t>(index);
      },
      [&](std::size_t item) { placed.push_back(item); }, [&](std::size_t item) { ++finished[item]; });
  ASSERT_EQ(placed.size(), kItems);
  for (std::size_t i = 0; i < kItems; ++i) {
    EXPECT_EQ(placed[i], i);
    EXPECT_EQ(finished[i], 1);
  }
}

TEST(InOrder, KeepsTheNumberOfItemsInBounds) {
  std::atomic<int> alive{0}, most{0};
  struct Item {
    explicit Item(std::atomic<int>& count, std::atomic<int>& largest) : count_(count) {
      const int now = ++count_;
      for (int seen = largest; seen < now && !largest.compare_exchange_weak(seen, now);) {
      }
    }
    ~Item() { --count_; }
    std::atomic<int>& count_;
  };
  in_order<Item>(
      500, 3, [&](std::size_t) { return std::make_unique<Item>(alive, most); }, [](Item&) {}, [](Item&) {});
  EXPECT_LE(most, 3);
  EXPECT_EQ(alive, 0);
}

TEST(InOrder, NoItemsAreNoWork) {
  in_order<int>(
      0, 3, [](std::size_t) { return std::make_unique<int>(); }, [](int&) { FAIL(); }, [](int&) { FAIL(); });
}

// Wherever it is thrown, it arrives, and nobody waits for the item that is missing.
TEST(InOrder, AnErrorEndsIt) {
  for (const int stage : {0, 1, 2})
    for (const std::size_t at : {0u, 3u, 99u}) {
      const auto fail = [&](int here, std::size_t index) {
        if (here == stage && index == at) throw std::runtime_error("enough");
      };
      EXPECT_THROW(in_order<std::size_t>(
                       100, 4,
                       [&](std::size_t index) {
                         fail(0, index);
                         return std::make_unique<std::size_t>(index);
                       },
                       [&](std::size_t item) { fail(1, item); }, [&](std::size_t item) { fail(2, item); }),
                   std::runtime_error);
    }
}

}  // namespace
}  // namespace stipple::test::octree_in_order
