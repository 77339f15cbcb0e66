#include "app/loop/ring.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <thread>

namespace lakshya {
namespace {

TEST(Ring, WhatIsPutInComesOutInOrder) {
  Ring<int, 4> ring;
  int value = -1;
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(value, -1);
  for (const int i : {3, 1, 2})
    EXPECT_TRUE(ring.push(i));
  for (const int i : {3, 1, 2}) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(ring.lost(), 0U);
}

TEST(Ring, AFullOneLosesTheNewestAndCounts) {
  Ring<int, 4> ring;
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(4));
  EXPECT_FALSE(ring.push(5));
  EXPECT_EQ(ring.lost(), 2U);
  int value = -1;
  EXPECT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 0);
  EXPECT_TRUE(ring.push(6));
  EXPECT_FALSE(ring.push(7));
  for (const int i : {1, 2, 3, 6}) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(ring.lost(), 3U);
}

TEST(Ring, ManyTimesAroundItIsAQueue) {
  Ring<int, 5> ring;
  std::deque<int> queue;
  std::uint64_t lost = 0;
  std::mt19937 random(7);
  for (int i = 0; i < 100'000; ++i) {
    // Now rather full, now rather empty.
    if (random() % 10 < (i / 100 % 2 == 0 ? 7U : 3U)) {
      const bool fits = queue.size() < 5;
      ASSERT_EQ(ring.push(i), fits);
      if (fits) queue.push_back(i);
      if (!fits) ++lost;
    } else {
      int value = -1;
      ASSERT_EQ(ring.pop(value), !queue.empty());
      if (queue.empty()) continue;
      ASSERT_EQ(value, queue.front());
      queue.pop_front();
    }
  }
  EXPECT_EQ(ring.lost(), lost);
  EXPECT_GT(lost, 100U);
}

struct Long {
  std::array<std::uint64_t, 21> words{};
};

TEST(Ring, AReaderInAnotherThreadGetsAllThatWasTakenInWholeAndInOrder) {
  constexpr std::uint64_t kValues = 1'000'000;
  Ring<Long, 16> ring;
  std::atomic<bool> over = false;
  std::uint64_t pushed = 0;
  std::thread writer([&] {
    Long value;
    for (std::uint64_t i = 1; i <= kValues; ++i) {
      value.words.fill(i);
      if (ring.push(value)) ++pushed;
      if (i % 64 == 0) std::this_thread::yield();
    }
    over = true;
  });
  std::uint64_t popped = 0;
  std::uint64_t torn = 0;
  std::uint64_t disordered = 0;
  std::uint64_t last = 0;
  Long value;
  for (;;) {
    const bool was_over = over;
    if (!ring.pop(value)) {
      if (was_over) break;
      std::this_thread::yield();
      continue;
    }
    ++popped;
    const std::uint64_t first = value.words.front();
    for (const std::uint64_t word : value.words) {
      if (word != first) ++torn;
    }
    if (first <= last) ++disordered;
    last = first;
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(disordered, 0U);
  EXPECT_EQ(popped, pushed);
  EXPECT_EQ(popped + ring.lost(), kValues);
}

}  // namespace
}  // namespace lakshya
