#include "kernels/support/support.h"

#include <gtest/gtest.h>

#include <iterator>

#include "kernels/base/units.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

// Three of nine, two of the six or four that are inside at the border.
constexpr SupportParams kThird{.radius = 1, .min_percent = 33, .max_difference = 16};

TEST(Support, KeepsWhatEnoughNeighboursShare) {
  const PaddedImage<std::int16_t> in(4, 3,
                                     {160, 165, 400, -3,  //
                                      170, 160, 160, -1,  //
                                      -4, 500, 177, 160});
  PaddedImage<std::int16_t> out(4, 3);
  ASSERT_EQ(support_ref(in.view(), kThird, {0, 3}, out.view()), Status::ok);
  const ImageView<std::int16_t> o = out.view();
  EXPECT_EQ(o.at(0, 0), 160);         // 160, 165, 170, 160
  EXPECT_EQ(o.at(1, 1), 160);         // 177 differs by 17
  EXPECT_EQ(o.at(2, 0), kNoSupport);  // alone
  EXPECT_EQ(o.at(1, 2), kNoSupport);
  EXPECT_EQ(o.at(2, 2), kNoSupport);  // only itself: 160 and 500 are too far
  EXPECT_EQ(o.at(3, 2), 160);         // itself and (2,1), of four
  EXPECT_EQ(o.at(3, 0), -3);          // reasons pass through
  EXPECT_EQ(o.at(0, 2), -4);
  EXPECT_TRUE(out.canaries_alive());
}

TEST(Support, CountsItself) {
  const PaddedImage<std::int16_t> in(1, 1, {0});
  PaddedImage<std::int16_t> out(1, 1);
  ASSERT_EQ(support_ref(in.view(), {.radius = 2, .min_percent = 100, .max_difference = 0}, {0, 1}, out.view()),
            Status::ok);
  EXPECT_EQ(out.view().at(0, 0), 0);
}

TEST(Support, MirrorsWithTheImage) {
  std::mt19937 random(4);
  PaddedImage<std::int16_t> in(33, 17);
  test::fill_random(in.view(), random, -5, 60);
  PaddedImage<std::int16_t> mirrored(33, 17);
  for (int v = 0; v < 17; ++v) {
    for (int u = 0; u < 33; ++u)
      mirrored.view().at(32 - u, v) = in.view().at(u, v);
  }
  PaddedImage<std::int16_t> a(33, 17);
  PaddedImage<std::int16_t> b(33, 17);
  const SupportParams params{.radius = 2, .min_percent = 32, .max_difference = 10};
  ASSERT_EQ(support_ref(in.view(), params, {0, 17}, a.view()), Status::ok);
  ASSERT_EQ(support_ref(mirrored.view(), params, {0, 17}, b.view()), Status::ok);
  for (int v = 0; v < 17; ++v) {
    for (int u = 0; u < 33; ++u)
      ASSERT_EQ(a.view().at(u, v), b.view().at(32 - u, v));
  }
}

// Surfaces with holes and outliers, so that neither all pixels nor none are supported.
void fill_surfaces(ImageView<std::int16_t> image, std::mt19937& random) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const int surface = 100 * ((u / 9 + v / 7) % 3) + static_cast<int>(random() % 24);
      const auto kind = random() % 10;
      image.at(u, v) = static_cast<std::int16_t>(kind == 0   ? -1 - static_cast<int>(random() % 6)
                                                 : kind == 1 ? static_cast<int>(random() % 32768)
                                                             : surface);
    }
  }
}

TEST(SupportSimd, EqualsTheReference) {
  std::mt19937 random(9);
  const SupportParams cases[] = {{},
                                 {.radius = 4, .min_percent = 50, .max_difference = 16},
                                 {.radius = 0, .min_percent = 100, .max_difference = 0},
                                 {.radius = 1, .min_percent = 0, .max_difference = 5},
                                 {.radius = 7, .min_percent = 33, .max_difference = 100000},
                                 {.radius = 15, .min_percent = 21, .max_difference = 9}};
  test::for_each_isa([&](const char* isa) {
    for (const int width : test::awkward_widths()) {
      for (const int height : {0, 1, 5, 18}) {
        PaddedImage<std::int16_t> in(width, height, 5, std::int16_t{40});
        fill_surfaces(in.view(), random);
        for (const SupportParams& p : cases) {
          PaddedImage<std::int16_t> expected(width, height);
          PaddedImage<std::int16_t> out(width, height);
          ASSERT_EQ(support_ref(in.view(), p, {0, height}, expected.view()), Status::ok);
          for (const Rows rows : {Rows{0, height / 2}, Rows{height / 2, height}})
            ASSERT_EQ(support_simd(in.view(), p, rows, out.view()), Status::ok);
          ASSERT_TRUE(test::equal_images(out.view(), expected.view()))
              << isa << " " << width << "x" << height << " radius " << p.radius;
          EXPECT_TRUE(out.canaries_alive());
        }
      }
    }
  });
}

// Differences that int16 cannot hold: any content is an input.
TEST(SupportSimd, EqualsTheReferenceAtTheEndsOfInt16) {
  std::mt19937 random(10);
  const int values[] = {-32768, -32767, -6, -1, 0, 1, 16, 17, 32750, 32766, 32767};
  test::for_each_isa([&](const char* isa) {
    for (const int max_difference : {0, 1, 16, 32766, 32767, 65536}) {
      PaddedImage<std::int16_t> in(77, 9);
      for (int v = 0; v < 9; ++v) {
        for (int u = 0; u < 77; ++u)
          in.view().at(u, v) = static_cast<std::int16_t>(values[random() % std::size(values)]);
      }
      PaddedImage<std::int16_t> expected(77, 9);
      PaddedImage<std::int16_t> out(77, 9);
      const SupportParams p{.radius = 2, .min_percent = 20, .max_difference = max_difference};
      ASSERT_EQ(support_ref(in.view(), p, {0, 9}, expected.view()), Status::ok);
      ASSERT_EQ(support_simd(in.view(), p, {0, 9}, out.view()), Status::ok);
      ASSERT_TRUE(test::equal_images(out.view(), expected.view())) << isa << " " << max_difference;
    }
  });
}

template <class Support>
class SupportRefusals : public testing::Test {};
struct Reference {
  static constexpr auto kRun = support_ref;
};
struct Simd {
  static constexpr auto kRun = support_simd;
};
using Implementations = testing::Types<Reference, Simd>;
TYPED_TEST_SUITE(SupportRefusals, Implementations);

TYPED_TEST(SupportRefusals, RefusesWrongArguments) {
  constexpr auto support = TypeParam::kRun;
  PaddedImage<std::int16_t> in(4, 4);
  PaddedImage<std::int16_t> out(4, 4);
  PaddedImage<std::int16_t> wrong(4, 3);
  EXPECT_EQ(support(in.view(), kThird, {0, 3}, wrong.view()), Status::size_mismatch);
  EXPECT_EQ(support(in.view(), kThird, {0, 5}, out.view()), Status::bad_argument);
  EXPECT_EQ(support(in.view(), {.radius = 16, .min_percent = 1}, {0, 4}, out.view()), Status::bad_argument);
  EXPECT_EQ(support(in.view(), {.radius = 1, .min_percent = 101}, {0, 4}, out.view()), Status::bad_argument);
  EXPECT_EQ(support(in.view(), {.radius = 1, .min_percent = -1}, {0, 4}, out.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya
