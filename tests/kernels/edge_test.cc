#include "kernels/edge/edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

// One of the two filters, with what every test needs to know about it.
struct Filter {
  const char* name;
  decltype(&edge_sobel_ref) run;
  decltype(&edge_sobel_ref) simd;
  int radius;
};

class Edge : public ::testing::TestWithParam<Filter> {
 protected:
  static PaddedImage<std::uint8_t> filter(const PaddedImage<std::uint8_t>& image, int width, int height, int cap) {
    PaddedImage<std::uint8_t> out(width, height);
    EXPECT_EQ(GetParam().run(image.view(), cap, {0, height}, out.view()), Status::ok);
    EXPECT_TRUE(out.canaries_alive());
    return out;
  }
};

INSTANTIATE_TEST_SUITE_P(Filters, Edge,
                         ::testing::Values(Filter{"sobel", edge_sobel_ref, edge_sobel_simd, kEdgeSobelRadius},
                                           Filter{"log", edge_log_ref, edge_log_simd, kEdgeLogRadius}),
                         [](const auto& filter) { return std::string(filter.param.name); });

TEST(EdgeSobel, HandComputed) {
  const PaddedImage<std::uint8_t> image(3, 3,
                                        {10, 0, 20,  //
                                         5, 99, 4,   //
                                         7, 0, 9});
  PaddedImage<std::uint8_t> out(3, 3);
  ASSERT_EQ(edge_sobel_ref(image.view(), 100, {0, 3}, out.view()), Status::ok);
  EXPECT_EQ(out.view().at(1, 1), 100 + (20 - 10) + 2 * (4 - 5) + (9 - 7));
  ASSERT_EQ(edge_sobel_ref(image.view(), 7, {0, 3}, out.view()), Status::ok);
  EXPECT_EQ(out.view().at(1, 1), 14);  // 10, capped
}

// The kernel itself, from its formula: one bright pixel at each place of the window, all others 0.
TEST(EdgeLog, OnePixelAnswersWithTheFormula) {
  int sum = 0;
  for (int y = -4; y <= 4; ++y) {
    for (int x = -4; x <= 4; ++x) {
      const double q = (x * x + y * y) / (2 * 1.4 * 1.4);
      const int k = static_cast<int>(std::floor(72 * (1 - q) * std::exp(-q) + 0.5));
      sum += k;
      PaddedImage<std::uint8_t> image(9, 9, 0, 0);
      image.view().at(4 + x, 4 + y) = 32;
      PaddedImage<std::uint8_t> out(9, 9);
      ASSERT_EQ(edge_log_ref(image.view(), 127, {0, 9}, out.view()), Status::ok);
      EXPECT_EQ(out.view().at(4, 4), 127 + k) << x << "," << y;
    }
  }
  EXPECT_EQ(sum, 0);
}

TEST(EdgeLog, RoundsHalvesUp) {
  PaddedImage<std::uint8_t> image(9, 9, 0, 0);
  PaddedImage<std::uint8_t> out(9, 9);
  const auto answer = [&](int u, int v, int grey) {
    image.view().at(u, v) = static_cast<std::uint8_t>(grey);
    EXPECT_EQ(edge_log_ref(image.view(), 127, {0, 9}, out.view()), Status::ok);
    image.view().at(u, v) = 0;
    return out.view().at(4, 4) - 127;
  };
  EXPECT_EQ(answer(1, 0, 16), 0);   // k = -1: -16 / 32 = -0.5
  EXPECT_EQ(answer(1, 0, 17), -1);  // -0.53
  EXPECT_EQ(answer(4, 4, 2), 5);    // k = 72: 144 / 32 = 4.5
  EXPECT_EQ(answer(2, 0, 8), 0);    // k = -2: -0.5
}

// The figures of the header: a vertical step of 16 grey levels.
TEST(EdgeStep, PeaksAsStated) {
  PaddedImage<std::uint8_t> image(21, 9);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 21; ++u)
      image.view().at(u, v) = u < 10 ? 100 : 116;
  }
  PaddedImage<std::uint8_t> out(21, 9);
  const auto peak = [&] { return *std::max_element(out.view().row(4), out.view().row(4) + 21) - 127; };
  ASSERT_EQ(edge_sobel_ref(image.view(), 127, {0, 9}, out.view()), Status::ok);
  EXPECT_EQ(peak(), 64);
  ASSERT_EQ(edge_log_ref(image.view(), 127, {0, 9}, out.view()), Status::ok);
  EXPECT_EQ(peak(), 56);
}

TEST_P(Edge, FlatImagesOfAnySizeHaveNoEdges) {
  for (const int width : {0, 1, 2, 3, 8, 9, 10}) {
    for (const int height : {0, 1, 3, 8, 9, 11}) {
      const PaddedImage<std::uint8_t> image(width, height, 3, 255);
      const PaddedImage<std::uint8_t> out = filter(image, width, height, 31);
      for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u)
          ASSERT_EQ(out.view().at(u, v), 31) << width << "x" << height;
      }
    }
  }
}

TEST_P(Edge, StaysWithinTheCapAndTheBorderHasNoEdge) {
  constexpr int kWidth = 33;
  constexpr int kHeight = 17;
  const int radius = GetParam().radius;
  std::mt19937 random(1);
  PaddedImage<std::uint8_t> image(kWidth, kHeight);
  test::fill_random(image.view(), random, 0, 255);
  for (const int cap : {1, 31, kMaxEdgeCap}) {
    const PaddedImage<std::uint8_t> out = filter(image, kWidth, kHeight, cap);
    int low = 255;
    int high = 0;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const int g = out.view().at(u, v);
        low = std::min(low, g);
        high = std::max(high, g);
        const bool inside = u >= radius && u < kWidth - radius && v >= radius && v < kHeight - radius;
        ASSERT_TRUE(inside || g == cap) << u << "," << v;
      }
    }
    EXPECT_EQ(low, 0);
    EXPECT_EQ(high, 2 * cap);
  }
}

TEST_P(Edge, BrightnessDoesNotMatter) {
  std::mt19937 random(2);
  PaddedImage<std::uint8_t> image(20, 12);
  test::fill_random(image.view(), random, 0, 200);
  PaddedImage<std::uint8_t> brighter(20, 12);
  for (int v = 0; v < 12; ++v) {
    for (int u = 0; u < 20; ++u)
      brighter.view().at(u, v) = static_cast<std::uint8_t>(image.view().at(u, v) + 55);
  }
  const PaddedImage<std::uint8_t> a = filter(image, 20, 12, 127);
  const PaddedImage<std::uint8_t> b = filter(brighter, 20, 12, 127);
  for (int v = 0; v < 12; ++v)
    ASSERT_TRUE(std::equal(a.view().row(v), a.view().row(v) + 20, b.view().row(v))) << v;
}

TEST_P(Edge, RowRangesGiveTheSameAsTheWholeAndWriteNothingElse) {
  std::mt19937 random(3);
  PaddedImage<std::uint8_t> image(30, 20);
  test::fill_random(image.view(), random, 0, 255);
  const PaddedImage<std::uint8_t> whole = filter(image, 30, 20, 60);
  PaddedImage<std::uint8_t> parts(30, 20, 5, 199);
  ASSERT_EQ(GetParam().run(image.view(), 60, {7, 20}, parts.view()), Status::ok);
  EXPECT_EQ(parts.view().at(15, 6), 199);
  ASSERT_EQ(GetParam().run(image.view(), 60, {0, 7}, parts.view()), Status::ok);
  for (int v = 0; v < 20; ++v)
    ASSERT_TRUE(std::equal(whole.view().row(v), whole.view().row(v) + 30, parts.view().row(v))) << v;
}

void expect_simd_equal(const Filter& filter, const PaddedImage<std::uint8_t>& image, int cap,
                       const std::string& what) {
  const int width = image.view().width;
  const int height = image.view().height;
  PaddedImage<std::uint8_t> expected(width, height);
  ASSERT_EQ(filter.run(image.view(), cap, {0, height}, expected.view()), Status::ok);
  PaddedImage<std::uint8_t> out(width, height, 5, 199);
  for (const Rows rows : {Rows{0, height / 3}, Rows{height / 3, height}})
    ASSERT_EQ(filter.simd(image.view(), cap, rows, out.view()), Status::ok);
  ASSERT_TRUE(test::equal_images(out.view(), expected.view())) << what;
  EXPECT_TRUE(out.canaries_alive()) << what;
}

TEST_P(Edge, SimdEqualsTheReference) {
  std::mt19937 random(4);
  test::for_each_isa([&](const char* isa) {
    std::vector<int> widths = test::awkward_widths();
    widths.insert(widths.end(), {2, 3, 9, 1031, 1032, 1033, 2100});  // strips of 1024 columns
    for (const int width : widths) {
      for (const int height : {0, 1, 2, 3, 8, 9, 13}) {
        PaddedImage<std::uint8_t> image(width, height, 0);
        const std::string what = std::string(isa) + " " + std::to_string(width) + "x" + std::to_string(height);
        test::fill_random(image.view(), random, 0, 255);
        ASSERT_NO_FATAL_FAILURE(expect_simd_equal(GetParam(), image, 127, what));
        test::fill_random(image.view(), random, 120, 130);  // small sums: roundings
        ASSERT_NO_FATAL_FAILURE(expect_simd_equal(GetParam(), image, 31, what));
      }
    }
  });
}

// Black where the answer to a single bright pixel is of one sign, white elsewhere, and parts of that: the largest sums
// there are, which no 16-bit number holds.
TEST_P(Edge, SimdEqualsTheReferenceOnTheLargestSums) {
  constexpr int kPeriod = 9;
  std::mt19937 random(5);
  PaddedImage<std::uint8_t> dot(kPeriod, kPeriod, 0, 0);
  std::vector<int> answer;
  for (int i = 0; i < kPeriod * kPeriod; ++i) {
    dot.view().at(i % kPeriod, i / kPeriod) = 32;
    PaddedImage<std::uint8_t> out(kPeriod, kPeriod);
    ASSERT_EQ(GetParam().run(dot.view(), 127, {0, kPeriod}, out.view()), Status::ok);
    answer.push_back(out.view().at(4, 4) - 127);
    dot.view().at(i % kPeriod, i / kPeriod) = 0;
  }
  test::for_each_isa([&](const char* isa) {
    for (int round = 0; round < 60; ++round) {
      // Of the pixels with coefficients between low and high the colour is turned round.
      const int low = std::uniform_int_distribution<int>(-11, 73)(random);
      const int high = std::uniform_int_distribution<int>(low, 73)(random);
      PaddedImage<std::uint8_t> image(75, 20, 0);
      for (int v = 0; v < 20; ++v) {
        for (int u = 0; u < 75; ++u) {
          const int place = v % kPeriod * kPeriod + u % kPeriod;
          const int k = answer[static_cast<std::size_t>(place)];
          const bool turned = round > 1 && k >= low && k <= high;
          image.view().at(u, v) = (k > 0) != (turned || round == 1) ? 255 : 0;
        }
      }
      for (const int cap : {31, 127})
        ASSERT_NO_FATAL_FAILURE(expect_simd_equal(GetParam(), image, cap, isa));
    }
  });
}

TEST_P(Edge, RefusesWrongArguments) {
  const PaddedImage<std::uint8_t> image(10, 10);
  PaddedImage<std::uint8_t> out(10, 10);
  PaddedImage<std::uint8_t> wrong(10, 9);
  for (const auto run : {GetParam().run, GetParam().simd}) {
    EXPECT_EQ(run(image.view(), 31, {0, 10}, wrong.view()), Status::size_mismatch);
    EXPECT_EQ(run(image.view(), 0, {0, 10}, out.view()), Status::bad_argument);
    EXPECT_EQ(run(image.view(), 128, {0, 10}, out.view()), Status::bad_argument);
    EXPECT_EQ(run(image.view(), 31, {0, 11}, out.view()), Status::bad_argument);
    EXPECT_EQ(run(image.view(), 31, {-1, 5}, out.view()), Status::bad_argument);
    EXPECT_EQ(run(image.view(), 31, {6, 5}, out.view()), Status::bad_argument);
  }
}

}  // namespace
}  // namespace lakshya
