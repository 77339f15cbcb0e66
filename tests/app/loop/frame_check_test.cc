#include "app/loop/frame_check.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;
using Bytes = PaddedImage<std::uint8_t>;

TEST(BrightnessShares, AreTheSharesOfBlackAndSaturatedPixels) {
  // At most 8 is black, at least 250 saturated: 3 and 2 of 8 pixels. The padding, 77, is neither.
  const Bytes image(4, 2, {0, 8, 9, 249, 250, 255, 3, 128});
  const BrightnessShares shares = brightness_shares(image.view(), {});
  EXPECT_DOUBLE_EQ(shares.dark, 3.0 / 8);
  EXPECT_DOUBLE_EQ(shares.bright, 2.0 / 8);
}

TEST(BrightnessShares, FollowTheLevels) {
  const Bytes image(3, 1, {10, 20, 30});
  EXPECT_DOUBLE_EQ(brightness_shares(image.view(), {.dark = 20, .bright = 30}).dark, 2.0 / 3);
  EXPECT_DOUBLE_EQ(brightness_shares(image.view(), {.dark = 20, .bright = 30}).bright, 1.0 / 3);
  EXPECT_EQ(brightness_shares(image.view(), {.dark = 9, .bright = 31}).dark, 0);
  EXPECT_EQ(brightness_shares(image.view(), {.dark = 9, .bright = 31}).bright, 0);
}

TEST(BrightnessShares, ThePaddingDoesNotCount) {
  for (const std::uint8_t padding : {std::uint8_t{0}, std::uint8_t{255}}) {
    Bytes image(7, 3, 9, padding);
    for (int v = 0; v < 3; ++v) {
      for (int u = 0; u < 7; ++u)
        image.view().at(u, v) = 128;
    }
    image.view().at(6, 2) = 0;
    image.view().at(0, 1) = 255;
    image.view().at(6, 0) = 255;
    EXPECT_DOUBLE_EQ(brightness_shares(image.view(), {}).dark, 1.0 / 21);
    EXPECT_DOUBLE_EQ(brightness_shares(image.view(), {}).bright, 2.0 / 21);
  }
}

TEST(BrightnessShares, OfAnImageOfOneKindAreZeroAndOne) {
  // Wide enough that a sum of eight bits would not do.
  const Bytes black(1283, 3, 0, 0);
  EXPECT_EQ(brightness_shares(black.view(), {}).dark, 1);
  EXPECT_EQ(brightness_shares(black.view(), {}).bright, 0);
  const Bytes white(1283, 3, 0, 255);
  EXPECT_EQ(brightness_shares(white.view(), {}).dark, 0);
  EXPECT_EQ(brightness_shares(white.view(), {}).bright, 1);
  EXPECT_EQ(brightness_shares({}, {}).dark, 0);
  EXPECT_EQ(brightness_shares({}, {}).bright, 0);
}

std::uint64_t hash_of(const Bytes& image) {
  Bytes copy(image.view().width, image.view().height, 3);
  return copy_and_hash(image.view(), copy.view());
}

Bytes random_image(int width, int height, int padding, std::uint8_t canary) {
  Bytes image(width, height, padding, canary);
  std::mt19937 random(17);
  test::fill_random(image.view(), random, 0, 255);
  return image;
}

TEST(CopyAndHash, CopiesThePixelsAndNothingElse) {
  for (const int width : {1, 7, 31, 32, 33, 67}) {
    const Bytes from = random_image(width, 5, 5, 77);
    Bytes to(width, 5, 11, 99);
    (void)copy_and_hash(from.view(), to.view());
    EXPECT_TRUE(test::equal_images(to.view(), from.view())) << width;
    EXPECT_TRUE(to.canaries_alive()) << width;
  }
}

TEST(CopyAndHash, EqualImagesGiveEqualNumbersWhateverLiesBetweenTheirRows) {
  for (const int width : {1, 8, 32, 67}) {
    const std::uint64_t expected = hash_of(random_image(width, 5, 0, 0));
    EXPECT_EQ(hash_of(random_image(width, 5, 5, 77)), expected) << width;
    EXPECT_EQ(hash_of(random_image(width, 5, 64, 200)), expected) << width;
  }
}

// Every place: in the words that are taken together and in the rest of the row.
TEST(CopyAndHash, APixelThatChangesAnywhereChangesTheNumber) {
  for (const int width : {1, 7, 31, 33, 67}) {
    Bytes image = random_image(width, 5, 5, 77);
    std::set<std::uint64_t> numbers{hash_of(image)};
    std::size_t images = 1;
    for (int v = 0; v < 5; ++v) {
      for (int u = 0; u < width; ++u) {
        std::uint8_t& pixel = image.view().at(u, v);
        for (const std::uint8_t bit : {std::uint8_t{1}, std::uint8_t{128}}) {
          pixel = static_cast<std::uint8_t>(pixel ^ bit);
          numbers.insert(hash_of(image));
          ++images;
          pixel = static_cast<std::uint8_t>(pixel ^ bit);
        }
      }
    }
    EXPECT_EQ(numbers.size(), images) << width;  // all of them different, not only from the first
  }
}

TEST(CopyAndHash, SwappedRowsChangeTheNumber) {
  for (const int width : {1, 7, 32, 67}) {
    const Bytes image = random_image(width, 6, 5, 77);
    const std::uint64_t expected = hash_of(image);
    for (int a = 0; a < 6; ++a) {
      for (int b = a + 1; b < 6; ++b) {
        Bytes swapped = image;
        std::swap_ranges(swapped.view().row(a), swapped.view().row(a) + width, swapped.view().row(b));
        EXPECT_NE(hash_of(swapped), expected) << width << ": " << a << ", " << b;
      }
    }
  }
}

TEST(CopyAndHash, SwappedPixelsChangeTheNumber) {
  for (const int width : {33, 67}) {
    const Bytes row = random_image(width, 1, 0, 0);
    const std::uint64_t expected = hash_of(row);
    for (int a = 0; a < width; ++a) {
      for (int b = a + 1; b < width; ++b) {
        Bytes swapped = row;
        std::swap(swapped.view().at(a, 0), swapped.view().at(b, 0));
        if (row.view().at(a, 0) != row.view().at(b, 0)) {
          EXPECT_NE(hash_of(swapped), expected) << a << ", " << b;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lakshya
