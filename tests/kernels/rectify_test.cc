#include "kernels/rectify/rectify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

// A map whose positions are given in 1/128 px.
struct PaddedMap {
  PaddedMap(int width, int height) : x(width, height), y(width, height), fraction(width, height) {}

  void set(int u, int v, int x_q7, int y_q7) {
    x.view().at(u, v) = static_cast<std::int16_t>(x_q7 >> kRectifyFractionBits);
    y.view().at(u, v) = static_cast<std::int16_t>(y_q7 >> kRectifyFractionBits);
    fraction.view().at(u, v) = rectify_fraction(x_q7 & 127, y_q7 & 127);
  }
  RectifyMap view() const { return {x.view(), y.view(), fraction.view()}; }

  PaddedImage<std::int16_t> x, y;
  PaddedImage<std::uint16_t> fraction;
};

std::uint8_t sample(const PaddedImage<std::uint8_t>& raw, double x, double y) {
  PaddedMap map(1, 1);
  map.set(0, 0, static_cast<int>(x * 128), static_cast<int>(y * 128));
  PaddedImage<std::uint8_t> out(1, 1);
  EXPECT_EQ(rectify_ref(raw.view(), map.view(), {0, 1}, out.view()), Status::ok);
  return out.view().at(0, 0);
}

TEST(Rectify, HandComputedBilinearValues) {
  const PaddedImage<std::uint8_t> raw(2, 2, {10, 20, 30, 50});
  EXPECT_EQ(sample(raw, 0, 0), 10);
  EXPECT_EQ(sample(raw, 1, 1), 50);
  EXPECT_EQ(sample(raw, 0.5, 0), 15);
  EXPECT_EQ(sample(raw, 0, 0.5), 20);
  EXPECT_EQ(sample(raw, 0.5, 0.5), 28);    // 27.5 rounds up
  EXPECT_EQ(sample(raw, 0.25, 0.75), 29);  // (10*3+20)/4 = 12.5, (30*3+50)/4 = 35, 12.5/4 + 35*3/4 = 29.375
}

TEST(Rectify, OutsideTheRawImageIsBlack) {
  const PaddedImage<std::uint8_t> raw(2, 2, {100, 100, 100, 100});
  EXPECT_EQ(sample(raw, -0.5, 0), 50);
  EXPECT_EQ(sample(raw, 1.75, 1), 25);
  EXPECT_EQ(sample(raw, 1, 1.5), 50);
  EXPECT_EQ(sample(raw, -1, 0), 0);
  EXPECT_EQ(sample(raw, 0, 3), 0);
  EXPECT_EQ(sample(raw, -30000, 30000), 0);
}

TEST(Rectify, WhiteStaysWhiteAtEveryFraction) {
  const PaddedImage<std::uint8_t> raw(2, 2, {255, 255, 255, 255});
  for (int x = 0; x < 128; ++x) {
    for (int y = 0; y < 128; ++y)
      ASSERT_EQ(sample(raw, x / 128.0, y / 128.0), 255);
  }
}

TEST(Rectify, MatchesBilinearInterpolationInDoubles) {
  std::mt19937 random(1);
  PaddedImage<std::uint8_t> raw(37, 23);
  test::fill_random(raw.view(), random, 0, 255);
  std::uniform_int_distribution<std::int32_t> x(0, 35 * 128 + 127);
  std::uniform_int_distribution<std::int32_t> y(0, 21 * 128 + 127);
  for (int i = 0; i < 5000; ++i) {
    const double px = x(random) / 128.0;
    const double py = y(random) / 128.0;
    const int u = static_cast<int>(px);
    const int v = static_cast<int>(py);
    const double a = px - u;
    const double b = py - v;
    const ImageView<const std::uint8_t> r = raw.view();
    const double exact = (1 - b) * ((1 - a) * r.at(u, v) + a * r.at(u + 1, v)) +
                         b * ((1 - a) * r.at(u, v + 1) + a * r.at(u + 1, v + 1));
    ASSERT_EQ(sample(raw, px, py), static_cast<int>(std::floor(exact + 0.5))) << px << " " << py;
  }
}

TEST(Rectify, FractionsShareSixteenBits) {
  for (int x = 0; x < 128; ++x) {
    for (int y = 0; y < 128; ++y) {
      ASSERT_EQ(rectify_fraction_x(rectify_fraction(x, y)), x);
      ASSERT_EQ(rectify_fraction_y(rectify_fraction(x, y)), y);
    }
  }
}

TEST(Rectify, WritesOnlyItsRowsAndNoPadding) {
  const PaddedImage<std::uint8_t> raw(2, 2, {9, 9, 9, 9});
  PaddedMap map(3, 4);
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 3; ++u)
      map.set(u, v, 0, 0);
  }
  PaddedImage<std::uint8_t> out(3, 4);
  ASSERT_EQ(rectify_ref(raw.view(), map.view(), {1, 3}, out.view()), Status::ok);
  for (int u = 0; u < 3; ++u) {
    EXPECT_EQ(out.view().at(u, 0), 77);
    EXPECT_EQ(out.view().at(u, 1), 9);
    EXPECT_EQ(out.view().at(u, 2), 9);
    EXPECT_EQ(out.view().at(u, 3), 77);
  }
  EXPECT_TRUE(out.canaries_alive());
}

TEST(Rectify, RefusesWrongShapes) {
  PaddedImage<std::uint8_t> raw(2, 2);
  PaddedMap map(3, 3);
  PaddedMap other(3, 2);
  PaddedImage<std::uint8_t> out(3, 3);
  const auto run = [&](const RectifyMap& m, Rows rows) { return rectify_ref(raw.view(), m, rows, out.view()); };
  EXPECT_EQ(run({other.x.view(), map.y.view(), map.fraction.view()}, {0, 1}), Status::size_mismatch);
  EXPECT_EQ(run({map.x.view(), other.y.view(), map.fraction.view()}, {0, 1}), Status::size_mismatch);
  EXPECT_EQ(run({map.x.view(), map.y.view(), other.fraction.view()}, {0, 1}), Status::size_mismatch);
  EXPECT_EQ(run(other.view(), {0, 1}), Status::size_mismatch);
  EXPECT_EQ(run(map.view(), {0, 4}), Status::bad_argument);
  EXPECT_EQ(run(map.view(), {-1, 1}), Status::bad_argument);
  EXPECT_EQ(rectify_ref({}, {}, {0, 0}, {}), Status::ok);
}

}  // namespace
}  // namespace lakshya
