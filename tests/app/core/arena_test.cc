#include "app/core/arena.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

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

TEST(Arena, APartLiesBetweenItsNeighbours) {
  Arena arena(1024);
  const auto before = arena.take<std::uint8_t>(64);
  Arena part = arena.part(256);
  const auto after = arena.take<std::uint8_t>(64);
  EXPECT_EQ(arena.used(), 64U + 256U + 64U);
  EXPECT_FALSE(part.measures());
  EXPECT_EQ(part.used(), 0U);
  const auto first = part.take<std::int32_t>(16);
  const auto second = part.take<std::uint8_t>(192);
  EXPECT_EQ(part.used(), 256U);
  EXPECT_EQ(reinterpret_cast<const std::uint8_t*>(first.data()), before.data() + 64);
  EXPECT_EQ(second.data(), before.data() + 128);
  EXPECT_EQ(after.data(), before.data() + 64 + 256);
  EXPECT_EQ(arena.used(), 64U + 256U + 64U);
}

TEST(Arena, APartRefusesMoreThanItWasGiven) {
  Arena arena(1024);
  Arena part = arena.part(128);
  (void)part.take<std::uint8_t>(100);
  EXPECT_THROW((void)part.take<std::uint8_t>(1), std::bad_alloc);
  EXPECT_THROW((void)arena.part(1024 - 128 + 1), std::bad_alloc);
}

TEST(Arena, APartOfNothingIsNoMeasuringOne) {
  Arena arena(128);
  Arena part = arena.part(0);
  EXPECT_FALSE(part.measures());
  EXPECT_THROW((void)part.take<std::uint8_t>(1), std::bad_alloc);
}

TEST(Arena, APartOfAMeasuringArenaIsCountedOnceAndMeasures) {
  Arena measure;
  Arena part = measure.part(100);
  EXPECT_EQ(measure.used(), 128U);
  EXPECT_TRUE(part.measures());
  EXPECT_TRUE(part.take<std::uint8_t>(1000).empty());
  EXPECT_EQ(measure.used(), 128U);
}

TEST(Arena, TheMemoryOutlivesItsPartAndMovesWithItsArena) {
  Arena arena(256);
  std::span<std::uint8_t> bytes;
  {
    Arena part = arena.part(128);
    bytes = part.take<std::uint8_t>(128);
  }
  Arena moved = std::move(arena);
  bytes[127] = 5;
  const auto rest = moved.take<std::uint8_t>(128);
  EXPECT_EQ(rest.data(), bytes.data() + 128);
  EXPECT_EQ(bytes[127], 5);
  EXPECT_THROW((void)moved.take<std::uint8_t>(1), std::bad_alloc);
}

}  // namespace
}  // namespace lakshya
