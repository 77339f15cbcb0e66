#include "app/loop/triple_buffer.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace lakshya {
namespace {

void put(TripleBuffer<int>& buffer, int value) {
  buffer.writing() = value;
  (void)buffer.publish();
}

TEST(TripleBuffer, NothingIsThereBeforeTheFirstValue) {
  TripleBuffer<int> buffer;
  EXPECT_FALSE(buffer.take());
  buffer.writing() = 5;
  EXPECT_FALSE(buffer.take());  // written, but not handed over
  EXPECT_EQ(buffer.reading(), 0);
}

TEST(TripleBuffer, AValueIsTakenOnceAndStays) {
  TripleBuffer<int> buffer;
  put(buffer, 5);
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.reading(), 5);
  EXPECT_FALSE(buffer.take());
  EXPECT_EQ(buffer.reading(), 5);
}

TEST(TripleBuffer, TheLatestWins) {
  TripleBuffer<int> buffer;
  for (int value = 1; value <= 7; ++value)
    put(buffer, value);
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.reading(), 7);
  EXPECT_FALSE(buffer.take());
  put(buffer, 8);
  EXPECT_EQ(buffer.reading(), 7);  // until it is taken
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.reading(), 8);
}

TEST(TripleBuffer, PublishTellsWhetherTheValueBeforeWasRead) {
  TripleBuffer<int> buffer;
  EXPECT_TRUE(buffer.publish());  // there was none
  EXPECT_FALSE(buffer.publish());
  EXPECT_TRUE(buffer.take());
  EXPECT_TRUE(buffer.publish());
  EXPECT_FALSE(buffer.publish());
  EXPECT_FALSE(buffer.publish());
  EXPECT_TRUE(buffer.take());
  EXPECT_FALSE(buffer.take());
  EXPECT_TRUE(buffer.publish());
}

// Neither's slot is ever the other's, whatever the order of their steps.
TEST(TripleBuffer, WriterAndReaderNeverHaveTheSameSlot) {
  for (unsigned order = 0; order < 1U << 12; ++order) {
    TripleBuffer<int> buffer;
    int written = 0;
    int read = 0;
    for (unsigned step = 0; step < 12; ++step) {
      if ((order >> step & 1U) != 0) {
        put(buffer, ++written);
      } else if (buffer.take()) {
        ASSERT_GT(buffer.reading(), read) << order;
        read = buffer.reading();
        ASSERT_EQ(read, written) << order;
      }
      ASSERT_NE(&buffer.writing(), &buffer.reading()) << order;
    }
  }
}

TEST(TripleBuffer, ThereAreThreeSlotsAndEachIsUsed) {
  TripleBuffer<int> buffer;
  std::set<const int*> all;
  for (const int& slot : buffer.slots())
    all.insert(&slot);
  EXPECT_EQ(all.size(), 3U);
  std::set<const int*> used;
  for (int i = 0; i < 6; ++i) {
    used.insert(&buffer.writing());
    (void)buffer.publish();
    if (i % 2 == 0) (void)buffer.take();
    used.insert(&buffer.reading());
  }
  EXPECT_EQ(used, all);
}

// A value longer than any machine writes at once.
struct Long {
  std::array<std::uint64_t, 37> words{};
};

TEST(TripleBuffer, AReaderInAnotherThreadSeesWholeAndEverNewerValues) {
  constexpr std::uint64_t kValues = 1'000'000;
  TripleBuffer<Long> buffer;
  std::uint64_t unread = 0;
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kValues; ++value) {
      buffer.writing().words.fill(value);
      if (!buffer.publish()) ++unread;
    }
  });
  std::uint64_t last = 0;
  std::uint64_t taken = 0;
  std::uint64_t torn = 0;
  std::uint64_t older = 0;
  while (last < kValues) {
    if (!buffer.take()) {
      std::this_thread::yield();
      continue;
    }
    ++taken;
    const Long& value = buffer.reading();
    const std::uint64_t first = value.words.front();
    for (const std::uint64_t word : value.words) {
      if (word != first) ++torn;
    }
    if (first <= last) ++older;
    last = first;
    if (older > 0) break;
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
  EXPECT_EQ(taken + unread, kValues);  // every value was read or known to be lost
}

}  // namespace
}  // namespace lakshya
