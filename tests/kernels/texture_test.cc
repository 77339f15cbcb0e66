#include "kernels/texture/texture.h"

#include <gtest/gtest.h>

#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

// 11 x 7: exactly one pixel, (5, 3), whose window with its gradient fits.
bool textured_at_center(const PaddedImage<std::uint8_t>& image, int threshold) {
  PaddedImage<std::uint8_t> flags(11, 7);
  EXPECT_EQ(texture_ref(image.view(), threshold, {0, 7}, flags.view()), Status::ok);
  for (int v = 0; v < 7; ++v) {
    for (int u = 0; u < 11; ++u) {
      const bool only_one = u == 5 && v == 3;
      EXPECT_TRUE(only_one || flags.view().at(u, v) == 0) << u << "," << v;
    }
  }
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

TEST(Texture, SmallImagesHaveNone) {
  for (const int width : {0, 1, 10}) {
    PaddedImage<std::uint8_t> flags(width, 6);
    ASSERT_EQ(texture_ref(PaddedImage<std::uint8_t>(width, 6).view(), 0, {0, 6}, flags.view()), Status::ok);
    for (int v = 0; v < 6; ++v) {
      for (int u = 0; u < width; ++u)
        EXPECT_EQ(flags.view().at(u, v), 0);
    }
    EXPECT_TRUE(flags.canaries_alive());
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

}  // namespace
}  // namespace lakshya
