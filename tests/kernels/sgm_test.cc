#include "kernels/sgm/sgm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "kernels/base/units.h"
#include "kernels/census/census.h"
#include "kernels/hamming/hamming.h"
#include "tests/support/test_image.h"
#include "tests/support/test_scratch.h"

namespace lakshya {
namespace {

using test::PaddedImage;
using test::Scratch;

SgmParams params_for(int width, int disparities) {
  SgmParams p;
  p.range = {.first = 0, .disparities = disparities, .valid_begin = 0, .valid_end = width};
  p.select = {.uniqueness_percent = 0, .left_right_max = -1, .offset16 = 0};
  return p;
}

// The definition once more, by another road: all path costs of the whole image in one volume, in plain ints, from
// explicit (dx, dy); costs straight from the codes.
class NaiveSgm {
 public:
  NaiveSgm(ImageView<const std::uint8_t> image, ImageView<const CensusCode> left, ImageView<const CensusCode> right,
           const SgmParams& p)
      : image_(image), left_(left), right_(right), p_(p) {}

  int winner(int u, int v) {
    std::vector<int> total(static_cast<std::size_t>(p_.range.disparities), 0);
    const int directions[5][2] = {{-1, 0}, {1, 0}, {0, -1}, {-1, -1}, {1, -1}};
    for (int k = 0; k < p_.paths; ++k) {
      const std::vector<int> path = along(u, v, directions[k][0], directions[k][1]);
      for (std::size_t i = 0; i < total.size(); ++i)
        total[i] = std::min(total[i] + path[i], 255);
    }
    return static_cast<int>(std::min_element(total.begin(), total.end()) - total.begin());
  }

 private:
  int cost(int u, int v, int d) const {
    int sum = 0;
    for (int y = v - 1; y <= v + 1; ++y) {
      for (int x = u - 1; x <= u + 1; ++x)
        sum += hamming(std::clamp(x, 0, left_.width - 1), std::clamp(y, 0, left_.height - 1), d);
    }
    return (sum + 1) / 2;
  }

  int hamming(int u, int v, int d) const {
    const int other = u - d - p_.range.first;
    if (other < p_.range.valid_begin || other >= p_.range.valid_end) return kOutsideCost;
    return __builtin_popcount(static_cast<unsigned>(left_.at(u, v) ^ right_.at(other, v)));
  }

  int penalty(int u, int v, int dx, int dy) const {
    const int step = std::abs(image_.at(u, v) - image_.at(u + dx, v + dy));
    return std::max(p_.p2_min, p_.p2 - p_.p2_slope * step);
  }

  std::vector<int> along(int u, int v, int dx, int dy) const {
    const auto n = static_cast<std::size_t>(p_.range.disparities);
    // Walk back to where the path enters, then forward again.
    int steps = 0;
    while (u + (steps + 1) * dx >= 0 && u + (steps + 1) * dx < left_.width && v + (steps + 1) * dy >= 0) {
      if (dy != 0 && steps + 1 > v) break;
      ++steps;
    }
    std::vector<int> path;
    for (; steps >= 0; --steps) {
      std::vector<int> next(n);
      for (std::size_t i = 0; i < n; ++i) {
        int value = cost(u + steps * dx, v + steps * dy, static_cast<int>(i));
        if (!path.empty()) {
          const int least = *std::min_element(path.begin(), path.end());
          const int p2 = penalty(u + steps * dx, v + steps * dy, dx, dy);
          int best = std::min(path[i], least + p2);
          if (i > 0) best = std::min(best, path[i - 1] + p_.p1);
          if (i + 1 < n) best = std::min(best, path[i + 1] + p_.p1);
          value = std::min(value + best - least, 255);
        }
        next[i] = value;
      }
      path = next;
    }
    return path;
  }

  ImageView<const std::uint8_t> image_;
  ImageView<const CensusCode> left_;
  ImageView<const CensusCode> right_;
  SgmParams p_;
};

void fill_codes(ImageView<CensusCode> image, std::mt19937& random) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u)
      image.at(u, v) = random() & 0xFFFFU;
  }
}

TEST(Sgm, EqualsTheDefinitionOnRandomCodes) {
  std::mt19937 random(5);
  for (const int paths : {3, 5}) {
    for (const int width : {1, 7, 21}) {
      constexpr int kHeight = 9;
      PaddedImage<CensusCode> left(width, kHeight);
      PaddedImage<CensusCode> right(width, kHeight);
      fill_codes(left.view(), random);
      fill_codes(right.view(), random);
      PaddedImage<std::uint8_t> image(width, kHeight);
      test::fill_random(image.view(), random, 100, 160);  // steps on both sides of where P2 reaches its least
      const PaddedImage<std::uint8_t> textured(width, kHeight, 3, 1);
      PaddedImage<std::int16_t> out(width, kHeight);
      SgmParams p = params_for(width, 16);
      p.paths = paths;
      p.range.first = -3;
      p.select.offset16 = 48;
      p.warmup_rows = 0;
      const Scratch scratch(sgm_scratch_bytes(width, 16));
      ASSERT_EQ(sgm_ref(image.view(), left.view(), right.view(), textured.view(), {0, kHeight}, p, {0, kHeight},
                        scratch.span(), out.view()),
                Status::ok);
      NaiveSgm naive(image.view(), left.view(), right.view(), p);
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < width; ++u) {
          const int best = naive.winner(u, v);
          const int other = u - best + 3;
          const int d16 = out.view().at(u, v);
          if (other < 0 || other >= width) {
            ASSERT_EQ(d16, kNotSearched) << u << "," << v;
          } else {
            ASSERT_NEAR(d16, 16 * best, 8) << u << "," << v << " paths " << paths;
          }
        }
      }
      EXPECT_TRUE(out.canaries_alive());
    }
  }
}

// A textured image shifted by a known disparity, with a step half way down.
TEST(Sgm, FindsAKnownShift) {
  constexpr int kWidth = 120;
  constexpr int kHeight = 40;
  std::mt19937 random(6);
  PaddedImage<std::uint8_t> left(kWidth, kHeight);
  PaddedImage<std::uint8_t> right(kWidth, kHeight);
  test::fill_random(left.view(), random, 0, 255);
  test::fill_random(right.view(), random, 0, 255);
  const auto shift = [](int v) { return v < 20 ? 5 : 11; };
  for (int v = 0; v < kHeight; ++v) {
    for (int u = shift(v); u < kWidth; ++u)
      right.view().at(u - shift(v), v) = left.view().at(u, v);
  }
  PaddedImage<CensusCode> census_left(kWidth, kHeight);
  PaddedImage<CensusCode> census_right(kWidth, kHeight);
  ASSERT_EQ(census_ref(left.view(), {0, kHeight}, census_left.view()), Status::ok);
  ASSERT_EQ(census_ref(right.view(), {0, kHeight}, census_right.view()), Status::ok);
  const PaddedImage<std::uint8_t> textured(kWidth, kHeight, 3, 1);
  PaddedImage<std::int16_t> out(kWidth, kHeight);
  SgmParams p = params_for(kWidth, 32);
  p.range.valid_begin = 4;
  p.range.valid_end = kWidth - 4;
  p.select = {.uniqueness_percent = 10, .left_right_max = 1, .offset16 = 0};
  const Scratch scratch(sgm_scratch_bytes(kWidth, 32));
  ASSERT_EQ(sgm_ref(left.view(), census_left.view(), census_right.view(), textured.view(), {3, kHeight - 3}, p,
                    {0, kHeight}, scratch.span(), out.view()),
            Status::ok);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int d16 = out.view().at(u, v);
      if (v < 3 || v >= kHeight - 3 || u < 4 || u >= kWidth - 4) {
        ASSERT_EQ(d16, kNotSearched);
      } else if (u >= 32 && (v < 16 || v >= 24)) {
        ASSERT_NEAR(d16, 16 * shift(v), 4) << u << "," << v;
      }
    }
  }
}

TEST(Sgm, BandsWithEnoughWarmUpEqualTheWholeAndTheResultDoesNotDependOnOtherBands) {
  constexpr int kWidth = 25;
  constexpr int kHeight = 30;
  std::mt19937 random(7);
  PaddedImage<std::uint8_t> image(kWidth, kHeight);
  test::fill_random(image.view(), random, 0, 255);
  PaddedImage<CensusCode> left(kWidth, kHeight);
  PaddedImage<CensusCode> right(kWidth, kHeight);
  fill_codes(left.view(), random);
  fill_codes(right.view(), random);
  const PaddedImage<std::uint8_t> textured(kWidth, kHeight, 3, 1);
  SgmParams p = params_for(kWidth, 16);
  p.warmup_rows = kHeight;
  const Scratch scratch(sgm_scratch_bytes(kWidth, 16));
  PaddedImage<std::int16_t> whole(kWidth, kHeight);
  PaddedImage<std::int16_t> bands(kWidth, kHeight);
  const auto run = [&](Rows rows, PaddedImage<std::int16_t>& out) {
    ASSERT_EQ(sgm_ref(image.view(), left.view(), right.view(), textured.view(), {0, kHeight}, p, rows,
                      scratch.span(), out.view()),
              Status::ok);
  };
  run({0, kHeight}, whole);
  run({20, 30}, bands);
  run({0, 13}, bands);
  run({13, 20}, bands);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      ASSERT_EQ(bands.view().at(u, v), whole.view().at(u, v)) << u << "," << v;
  }
}

TEST(Sgm, ScratchDoesNotGrowWithTheImageAndIsNotOverrun) {
  constexpr int kWidth = 17;
  const std::size_t bytes = sgm_scratch_bytes(kWidth, 16);
  // Some 18 rows of candidates, padded to vectors of 64 bytes with a pixel of margin on both sides.
  EXPECT_LT(bytes, std::size_t{18 * ((17 + 2) * 64 + 128) + 4096});
  std::mt19937 random(8);
  PaddedImage<CensusCode> codes(kWidth, 200);
  fill_codes(codes.view(), random);
  const PaddedImage<std::uint8_t> image(kWidth, 200);
  const PaddedImage<std::uint8_t> textured(kWidth, 200, 3, 1);
  PaddedImage<std::int16_t> out(kWidth, 200);
  const Scratch scratch(bytes + 64);
  std::fill(scratch.span().begin(), scratch.span().end(), std::byte{0x5A});
  const SgmParams p = params_for(kWidth, 16);
  ASSERT_EQ(sgm_ref(image.view(), codes.view(), codes.view(), textured.view(), {0, 200}, p, {0, 200},
                    scratch.span().first(bytes), out.view()),
            Status::ok);
  for (std::size_t i = bytes; i < bytes + 64; ++i)
    ASSERT_EQ(scratch.span()[i], std::byte{0x5A});
}

TEST(Sgm, RefusesWrongArguments) {
  PaddedImage<CensusCode> codes(20, 10);
  PaddedImage<std::uint8_t> image(20, 10);
  PaddedImage<std::uint8_t> textured(20, 10);
  PaddedImage<std::int16_t> out(20, 10);
  const Scratch scratch(sgm_scratch_bytes(20, 16));
  const auto run = [&](const SgmParams& p, Rows rows, std::span<std::byte> bytes) {
    return sgm_ref(image.view(), codes.view(), codes.view(), textured.view(), {0, 10}, p, rows, bytes, out.view());
  };
  SgmParams p = params_for(20, 16);
  EXPECT_EQ(run(p, {0, 10}, scratch.span().first(scratch.span().size() - 1)), Status::scratch_too_small);
  EXPECT_EQ(run(p, {0, 11}, scratch.span()), Status::bad_argument);
  p.p1 = 37;
  EXPECT_EQ(run(p, {0, 10}, scratch.span()), Status::bad_argument);
  p = params_for(20, 16);
  p.p2 = 185;
  EXPECT_EQ(run(p, {0, 10}, scratch.span()), Status::bad_argument);
  p = params_for(20, 16);
  p.p2_min = 136;
  EXPECT_EQ(run(p, {0, 10}, scratch.span()), Status::bad_argument);
  p = params_for(20, 16);
  p.p2_slope = 256;
  EXPECT_EQ(run(p, {0, 10}, scratch.span()), Status::bad_argument);
  p = params_for(20, 16);
  p.paths = 4;
  EXPECT_EQ(run(p, {0, 10}, scratch.span()), Status::bad_argument);
  PaddedImage<std::int16_t> wrong(19, 10);
  EXPECT_EQ(sgm_ref(image.view(), codes.view(), codes.view(), textured.view(), {0, 10}, params_for(20, 16), {0, 10},
                    scratch.span(), wrong.view()),
            Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya
