#include "kernels/rectify/rectify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/each_isa.h"
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

// `raw` and `map`: what one frame has. Padding 0: a read behind the last raw row is outside the memory.
void expect_simd_equal(const PaddedImage<std::uint8_t>& raw, const PaddedMap& map, const std::string& what) {
  const int width = map.view().x.width;
  const int height = map.view().x.height;
  PaddedImage<std::uint8_t> expected(width, height);
  ASSERT_EQ(rectify_ref(raw.view(), map.view(), {0, height}, expected.view()), Status::ok);
  PaddedImage<std::uint8_t> out(width, height);
  for (const Rows rows : {Rows{0, height / 2}, Rows{height / 2, height}})
    ASSERT_EQ(rectify_simd(raw.view(), map.view(), rows, out.view()), Status::ok);
  ASSERT_TRUE(test::equal_images(out.view(), expected.view())) << what;
  EXPECT_TRUE(out.canaries_alive()) << what;
}

// A map that turns, stretches and shifts: dx_u is how far x moves with u, in 1/128 px.
struct Affine {
  int x, y;
  int dx_u, dx_v;
  int dy_u, dy_v;
};

PaddedMap affine_map(int width, int height, const Affine& a, std::mt19937& random, int noise_q7) {
  std::uniform_int_distribution<int> noise(-noise_q7, noise_q7);
  PaddedMap map(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int x = a.x * 128 + a.dx_u * u + a.dx_v * v + noise(random);
      const int y = a.y * 128 + a.dy_u * u + a.dy_v * v + noise(random);
      map.set(u, v, x, y);
    }
  }
  return map;
}

TEST(RectifySimd, EqualsTheReferenceOnLensesOfAllKinds) {
  std::mt19937 random(5);
  const Affine lenses[] = {
      {0, 0, 128, 0, 0, 128},        // identity
      {3, 2, 117, 4, -3, 121},       // a usual one
      {-7, -5, 140, 0, 0, 133},      // borders outside on all sides
      {70, 30, -128, 0, 0, -128},    // upside down
      {0, 10, 128, 5, 18, 128},      // two rows within eight pixels
      {0, 0, 110, -60, 60, 110},     // turned by 30 degrees
      {60, 0, 0, -128, 128, 0},      // turned by 90 degrees
      {0, 0, 250, 0, 0, 250},        // half the size
      {0, 0, 300, 0, 130, 300},      // more than the windows hold
      {-200, -100, 600, 0, 0, 600},  // far outside
      {-32768, 32767, 0, 0, 0, 0},   // nowhere
      {32767, 32767, 0, 0, 0, 0},    //
      {16, 16, 0, 0, 0, 0},          // one place
  };
  test::for_each_isa([&](const char* isa) {
    for (const int width : test::awkward_widths()) {
      for (const Affine& lens : lenses) {
        for (const int noise : {0, 90}) {
          PaddedImage<std::uint8_t> raw(80, 40, 0);
          test::fill_random(raw.view(), random, 0, 255);
          const PaddedMap map = affine_map(width, 7, lens, random, std::abs(lens.x) < 32767 ? noise : 0);
          ASSERT_NO_FATAL_FAILURE(expect_simd_equal(
              raw, map, std::string(isa) + " width " + std::to_string(width) + " x " + std::to_string(lens.x)));
        }
      }
    }
  });
}

TEST(RectifySimd, EqualsTheReferenceOnRawImagesOfAnySize) {
  std::mt19937 random(6);
  test::for_each_isa([&](const char* isa) {
    for (const int width : {0, 1, 15, 16, 17, 40}) {
      for (const int height : {0, 1, 2, 3, 8, 9, 10, 33}) {
        PaddedImage<std::uint8_t> raw(width, height, 0);
        test::fill_random(raw.view(), random, 0, 255);
        for (const int slope : {0, 40}) {
          const PaddedMap map = affine_map(75, 45, {-6, -6, 100, 0, slope, 128}, random, 30);
          ASSERT_NO_FATAL_FAILURE(expect_simd_equal(
              raw, map, std::string(isa) + " raw " + std::to_string(width) + "x" + std::to_string(height)));
        }
      }
    }
  });
}

TEST(RectifySimd, EqualsTheReferenceAtEveryFraction) {
  PaddedImage<std::uint8_t> raw(160, 20, 0);
  std::mt19937 random(7);
  test::for_each_isa([&](const char* isa) {
    for (const int low : {0, 255}) {
      for (int v = 0; v < 20; ++v) {
        for (int u = 0; u < 160; ++u)
          raw.view().at(u, v) = static_cast<std::uint8_t>(random() % 2 == 0 ? low : 255);
      }
      PaddedMap map(128, 128);
      for (int v = 0; v < 128; ++v) {
        for (int u = 0; u < 128; ++u)
          map.set(u, v, u * 129, (v / 8) * 128 + v);
      }
      ASSERT_NO_FATAL_FAILURE(expect_simd_equal(raw, map, isa));
    }
  });
}

TEST(RectifySimd, RefusesWrongShapes) {
  PaddedImage<std::uint8_t> raw(2, 2);
  PaddedMap map(3, 3);
  PaddedMap other(3, 2);
  PaddedImage<std::uint8_t> out(3, 3);
  EXPECT_EQ(rectify_simd(raw.view(), other.view(), {0, 1}, out.view()), Status::size_mismatch);
  EXPECT_EQ(rectify_simd(raw.view(), map.view(), {0, 4}, out.view()), Status::bad_argument);
  EXPECT_EQ(rectify_simd({}, {}, {0, 0}, {}), Status::ok);
}

}  // namespace
}  // namespace lakshya
