#include "kernels/support/support.h"

#include <gtest/gtest.h>

#include "kernels/base/units.h"
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

TEST(Support, RefusesWrongArguments) {
  PaddedImage<std::int16_t> in(4, 4);
  PaddedImage<std::int16_t> out(4, 4);
  PaddedImage<std::int16_t> wrong(4, 3);
  EXPECT_EQ(support_ref(in.view(), kThird, {0, 3}, wrong.view()), Status::size_mismatch);
  EXPECT_EQ(support_ref(in.view(), kThird, {0, 5}, out.view()), Status::bad_argument);
  EXPECT_EQ(support_ref(in.view(), {.radius = 16, .min_percent = 1}, {0, 4}, out.view()), Status::bad_argument);
  EXPECT_EQ(support_ref(in.view(), {.radius = 1, .min_percent = 101}, {0, 4}, out.view()), Status::bad_argument);
  EXPECT_EQ(support_ref(in.view(), {.radius = 1, .min_percent = -1}, {0, 4}, out.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya
