#include "app/tools/sim/textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace lakshya::sim {
namespace {

constexpr int kSide = TexturePicture::kSide;

class EachTexture : public ::testing::TestWithParam<std::size_t> {
 protected:
  Texture texture() const { return static_cast<Texture>(GetParam()); }
  const TexturePicture& picture() const { return texture_picture(texture(), 1); }
};

TEST_P(EachTexture, MeanIsAHalfAndContrastIsThatOfTheMaterial) {
  double sum = 0;
  double squares = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double t = picture().texel(x, y);
      sum += t;
      squares += t * t;
    }
  }
  const double mean = sum / (kSide * kSide);
  const double deviation = std::sqrt(squares / (kSide * kSide) - mean * mean);
  EXPECT_NEAR(mean, 0.5, 0.02);
  if (texture() == Texture::plain) {
    EXPECT_LT(deviation, 0.02);
  } else {
    EXPECT_GT(deviation, 0.1);
  }
}

// Differences across the border, in the mean, are not larger than those between the worst of the inner columns and rows.
TEST_P(EachTexture, HasNoSeam) {
  const auto column_step = [&](int x) {
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
      sum += std::abs(static_cast<double>(picture().texel((x + 1) % kSide, y) - picture().texel(x, y)));
    return sum;
  };
  const auto row_step = [&](int y) {
    double sum = 0;
    for (int x = 0; x < kSide; ++x)
      sum += std::abs(static_cast<double>(picture().texel(x, (y + 1) % kSide) - picture().texel(x, y)));
    return sum;
  };
  double column = 0;
  double row = 0;
  for (int i = 0; i < kSide - 1; ++i) {
    column = std::max(column, column_step(i));
    row = std::max(row, row_step(i));
  }
  EXPECT_LE(column_step(kSide - 1), 1.05 * column);
  EXPECT_LE(row_step(kSide - 1), 1.05 * row);
}

TEST_P(EachTexture, HasDetailFarAndNear) {
  if (texture() == Texture::plain) return;
  for (const int level : {0, 2, 3}) {
    float low = 1;
    float high = 0;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
      const float t = picture().sample((i % 64) << 26, (i / 64) << 26, level);
      low = std::min(low, t);
      high = std::max(high, t);
    }
    EXPECT_GT(high - low, 0.2F) << level;
  }
}

TEST_P(EachTexture, SeedsDiffer) {
  if (texture() == Texture::wallpaper) return;  // its figure is the same
  const TexturePicture& other = texture_picture(texture(), 2);
  int same = 0;
  for (int i = 0; i < kSide; ++i)
    same += picture().texel(i, (i * 7) % kSide) == other.texel(i, (i * 7) % kSide) ? 1 : 0;
  EXPECT_LT(same, kSide / 2);
}

INSTANTIATE_TEST_SUITE_P(Textures, EachTexture, ::testing::Range<std::size_t>(0, kTextureNames.size()),
                         [](const auto& i) { return std::string(kTextureNames[i.param]); });

TEST(Textures, WallpaperRepeatsExactly) {
  const TexturePicture& p = texture_picture(Texture::wallpaper, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      ASSERT_EQ(p.texel(x, y), p.texel((x + 128) % kSide, y));
      ASSERT_EQ(p.texel(x, y), p.texel(x, (y + 128) % kSide));
    }
  }
}

TEST(Textures, SamplingMeetsTheTexelsAndWraps) {
  const TexturePicture& p = texture_picture(Texture::gravel, 0);
  for (const int x : {0, 1, 17, 511}) {
    const float u = (static_cast<float>(x) + 0.5F) / kSide;
    EXPECT_NEAR(p.sample(TexturePicture::fixed(u), TexturePicture::fixed(0.5F / kSide), 0), p.texel(x, 0), 1e-4);
    EXPECT_NEAR(p.sample(TexturePicture::fixed(u - 3), TexturePicture::fixed(7 + 0.5F / kSide), 0), p.texel(x, 0),
                5e-3);
  }
  const std::uint32_t between = TexturePicture::fixed(1.0F / kSide);
  EXPECT_NEAR(p.sample(between, TexturePicture::fixed(0.5F / kSide), 0), (p.texel(0, 0) + p.texel(1, 0)) / 2, 1e-4);
}

TEST(Textures, SeedsCountModuloFour) {
  EXPECT_EQ(&texture_picture(Texture::brick, 2), &texture_picture(Texture::brick, 6));
}

}  // namespace
}  // namespace lakshya::sim
