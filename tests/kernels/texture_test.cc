#include "kernels/texture/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

// 11 x 7: only at (5, 3) the window and its gradient stay inside the image.
bool textured_at_center(const PaddedImage<std::uint8_t>& image, int threshold) {
  PaddedImage<std::uint8_t> flags(11, 7);
  EXPECT_EQ(texture_ref(image.view(), threshold, {0, 7}, flags.view()), Status::ok);
  return flags.view().at(5, 3) != 0;
}

TEST(Texture, SumsTheGradientOverTheWindow) {
  PaddedImage<std::uint8_t> ramp(11, 7);
  for (int v = 0; v < 7; ++v) {
    for (int u = 0; u < 11; ++u)
      ramp.view().at(u, v) = static_cast<std::uint8_t>(3 * u);
  }
  // |I(x+1) - I(x-1)| = 6 at each of the 63 pixels.
  EXPECT_TRUE(textured_at_center(ramp, 378));
  EXPECT_FALSE(textured_at_center(ramp, 379));
}

TEST(Texture, OnePixelCountsForBothItsNeighbours) {
  PaddedImage<std::uint8_t> image(11, 7, 3, 20);
  image.view().at(5, 3) = 30;
  EXPECT_TRUE(textured_at_center(image, 20));
  EXPECT_FALSE(textured_at_center(image, 21));
}

TEST(Texture, VerticalStructureDoesNotCount) {
  PaddedImage<std::uint8_t> image(11, 7);
  for (int v = 0; v < 7; ++v) {
    for (int u = 0; u < 11; ++u)
      image.view().at(u, v) = static_cast<std::uint8_t>(40 * (v % 2));
  }
  EXPECT_FALSE(textured_at_center(image, 1));
  EXPECT_TRUE(textured_at_center(image, 0));
}

// As if the image were larger, with its border pixels repeated outwards.
TEST(Texture, TheBorderIsRepeated) {
  std::mt19937 random(9);
  for (const int width : {1, 10, 13}) {
    for (const int height : {1, 6, 9}) {
      PaddedImage<std::uint8_t> image(width, height);
      test::fill_random(image.view(), random, 0, 12);
      PaddedImage<std::uint8_t> larger(width + 10, height + 6);
      for (int v = 0; v < height + 6; ++v) {
        for (int u = 0; u < width + 10; ++u) {
          larger.view().at(u, v) =
              image.view().at(std::clamp(u - 5, 0, width - 1), std::clamp(v - 3, 0, height - 1));
        }
      }
      PaddedImage<std::uint8_t> flags(width, height);
      PaddedImage<std::uint8_t> expected(width + 10, height + 6);
      ASSERT_EQ(texture_ref(image.view(), 230, {0, height}, flags.view()), Status::ok);
      ASSERT_EQ(texture_ref(larger.view(), 230, {0, height + 6}, expected.view()), Status::ok);
      for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u)
          ASSERT_EQ(flags.view().at(u, v), expected.view().at(u + 5, v + 3)) << u << "," << v;
      }
      EXPECT_TRUE(flags.canaries_alive());
    }
  }
}

TEST(Texture, RefusesWrongArguments) {
  PaddedImage<std::uint8_t> image(11, 7);
  PaddedImage<std::uint8_t> flags(11, 7);
  PaddedImage<std::uint8_t> wrong(10, 7);
  EXPECT_EQ(texture_ref(image.view(), 1, {0, 7}, wrong.view()), Status::size_mismatch);
  EXPECT_EQ(texture_ref(image.view(), -1, {0, 7}, flags.view()), Status::bad_argument);
  EXPECT_EQ(texture_ref(image.view(), 1, {5, 8}, flags.view()), Status::bad_argument);
}

void expect_simd_equal(const PaddedImage<std::uint8_t>& image, int threshold, const std::string& what) {
  const int width = image.view().width;
  const int height = image.view().height;
  PaddedImage<std::uint8_t> expected(width, height);
  ASSERT_EQ(texture_ref(image.view(), threshold, {0, height}, expected.view()), Status::ok);
  PaddedImage<std::uint8_t> flags(width, height);
  for (const Rows rows : {Rows{0, height / 3}, Rows{height / 3, height}})
    ASSERT_EQ(texture_simd(image.view(), threshold, rows, flags.view()), Status::ok);
  ASSERT_TRUE(test::equal_images(flags.view(), expected.view())) << what << " threshold " << threshold;
  EXPECT_TRUE(flags.canaries_alive()) << what;
}

// Thresholds around the mean of the sums, where a wrong sum shows.
TEST(TextureSimd, EqualsTheReference) {
  std::mt19937 random(10);
  test::for_each_isa([&](const char* isa) {
    std::vector<int> widths = test::awkward_widths();
    widths.insert(widths.end(), {2, 3, 1023, 1024, 1025, 2100});  // strips of 1024 columns
    for (const int width : widths) {
      for (const int height : {0, 1, 3, 7, 8, 15}) {
        PaddedImage<std::uint8_t> image(width, height, 0);
        test::fill_random(image.view(), random, 0, 12);
        const std::string what = std::string(isa) + " " + std::to_string(width) + "x" + std::to_string(height);
        for (const int threshold : {0, 230, 252})
          ASSERT_NO_FATAL_FAILURE(expect_simd_equal(image, threshold, what));
      }
    }
  });
}

// The largest sum there is: 63 times 255.
TEST(TextureSimd, NoSumIsTooLarge) {
  PaddedImage<std::uint8_t> image(150, 9, 0);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 150; ++u)
      image.view().at(u, v) = u / 2 % 2 == 0 ? 0 : 255;
  }
  test::for_each_isa([&](const char* isa) {
    for (const int threshold : {16064, 16065, 16066, 0x7fff, 0x8000, 0x10000, 0x7fffffff})
      ASSERT_NO_FATAL_FAILURE(expect_simd_equal(image, threshold, isa));
    PaddedImage<std::uint8_t> flags(150, 9);
    ASSERT_EQ(texture_simd(image.view(), 16065, {0, 9}, flags.view()), Status::ok);
    EXPECT_EQ(flags.view().at(75, 4), 1);
  });
}

TEST(TextureSimd, RefusesWrongArguments) {
  PaddedImage<std::uint8_t> image(11, 7);
  PaddedImage<std::uint8_t> flags(11, 7);
  PaddedImage<std::uint8_t> wrong(10, 7);
  EXPECT_EQ(texture_simd(image.view(), 1, {0, 7}, wrong.view()), Status::size_mismatch);
  EXPECT_EQ(texture_simd(image.view(), -1, {0, 7}, flags.view()), Status::bad_argument);
  EXPECT_EQ(texture_simd(image.view(), 1, {5, 8}, flags.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya
