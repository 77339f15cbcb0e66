#include "app/core/arena.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace lakshya {
namespace {

TEST(Arena, MeasuringHandsOutNothingAndAddsUp) {
  Arena measure;
  EXPECT_TRUE(measure.take<std::uint8_t>(1).empty());
  EXPECT_EQ(measure.take_image<std::uint32_t>(10, 10).data, nullptr);
  EXPECT_EQ(measure.used(), 64U + 448U);  // each rounded up to 64 bytes
}

TEST(Arena, PiecesAreAlignedZeroedAndApart) {
  Arena arena(1024);
  const auto a = arena.take<std::uint8_t>(3);
  const auto b = arena.take<std::int64_t>(5);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % Arena::kAlignment, 0U);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(b.data()) % Arena::kAlignment, 0U);
  EXPECT_GE(reinterpret_cast<std::uintptr_t>(b.data()), reinterpret_cast<std::uintptr_t>(a.data()) + 3);
  for (const std::int64_t x : b)
    EXPECT_EQ(x, 0);
}

TEST(Arena, RefusesMoreThanItHas) {
  Arena arena(128);
  (void)arena.take<std::uint8_t>(128);
  EXPECT_THROW((void)arena.take<std::uint8_t>(1), std::bad_alloc);
}

}  // namespace
}  // namespace lakshya
