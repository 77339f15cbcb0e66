// The two window matchers, a random pair for them, and their definition by another road.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <span>
#include <vector>

#include "kernels/base/units.h"
#include "kernels/block/block.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sad/sad.h"
#include "tests/support/test_image.h"
#include "tests/support/test_scratch.h"

namespace lakshya::test {

// What the two differ in.
struct CensusBlock {
  using Descriptor = CensusCode;
  static constexpr auto kMatch = census_block_ref;
  static constexpr auto kReference = census_block_ref;
  static constexpr auto kDescribe = census_ref;
  static constexpr int kRadiusU = kCensusRadiusU;
  static constexpr int kRadiusV = kCensusRadiusV;
  static Descriptor random_value(std::mt19937& random, int /*edge_cap*/) {
    return static_cast<Descriptor>(random() & 0xFFFFU);
  }
  static int cost(Descriptor a, Descriptor b) { return std::popcount(static_cast<Descriptor>(a ^ b)); }
  static int outside(int /*edge_cap*/) { return kOutsideCost; }
};

struct SadBlock {
  using Descriptor = std::uint8_t;
  static constexpr auto kMatch = sad_block_ref;
  static constexpr auto kReference = sad_block_ref;
  static constexpr auto kDescribe = [](ImageView<const std::uint8_t> image, Rows rows, ImageView<Descriptor> out) {
    return edge_log_ref(image, BlockParams{}.edge_cap, rows, out);
  };
  static constexpr int kRadiusU = kEdgeLogRadius;
  static constexpr int kRadiusV = kEdgeLogRadius;
  static Descriptor random_value(std::mt19937& random, int edge_cap) {
    // Both ends often: the largest sums.
    const int value = static_cast<int>(random() % static_cast<unsigned>(8 * edge_cap)) - 3 * edge_cap;
    return static_cast<Descriptor>(std::clamp(value, 0, 2 * edge_cap));
  }
  static int cost(Descriptor a, Descriptor b) { return std::abs(a - b); }
  static int outside(int edge_cap) { return sad_outside_cost(edge_cap); }
};

struct CensusBlockSimd : CensusBlock {
  static constexpr auto kMatch = census_block_simd;
};

struct SadBlockSimd : SadBlock {
  static constexpr auto kMatch = sad_block_simd;
};

// Random descriptors; one texture flag in eight is off.
template <class Matcher>
class BlockPair {
 public:
  using Descriptor = typename Matcher::Descriptor;

  BlockPair(int width, int height, unsigned seed, int edge_cap = 31)
      : width_(width),
        height_(height),
        left_(width, height),
        right_(width, height),
        textured_(width, height, 3, 1) {
    std::mt19937 random(seed);
    for (PaddedImage<Descriptor>* image : {&left_, &right_}) {
      for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u)
          image->view().at(u, v) = Matcher::random_value(random, edge_cap);
      }
    }
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u)
        textured_.view().at(u, v) = random() % 8 != 0 ? 1 : 0;
    }
  }

  Status match(const BlockParams& p, Rows descriptor_rows, Rows rows, std::span<std::byte> scratch,
               ImageView<std::int16_t> out) const {
    return Matcher::kMatch(left_.view(), right_.view(), textured_.view(), descriptor_rows, p, rows, scratch, out);
  }

  PaddedImage<std::int16_t> matched(const BlockParams& p, Rows descriptor_rows) const {
    const Scratch scratch(block_scratch_bytes(width_, p.range.disparities, p.radius_v));
    std::fill(scratch.span().begin(), scratch.span().end(), std::byte{0x5A});
    PaddedImage<std::int16_t> out(width_, height_);
    EXPECT_EQ(match(p, descriptor_rows, {0, height_}, scratch.span(), out.view()), Status::ok);
    EXPECT_TRUE(out.canaries_alive());
    return out;
  }

  // By the reference implementation.
  PaddedImage<std::int16_t> reference(const BlockParams& p, Rows descriptor_rows) const {
    const Scratch scratch(block_scratch_bytes(width_, p.range.disparities, p.radius_v));
    PaddedImage<std::int16_t> out(width_, height_);
    EXPECT_EQ(Matcher::kReference(left_.view(), right_.view(), textured_.view(), descriptor_rows, p, {0, height_},
                                  scratch.span(), out.view()),
              Status::ok);
    return out;
  }

  // The definition: for each pixel and candidate the whole window.
  PaddedImage<std::int16_t> defined(const BlockParams& p, Rows descriptor_rows) const {
    PaddedImage<std::int16_t> out(width_, height_);
    std::vector<std::int16_t> scratch(select_scratch_elements(width_));
    for (int v = 0; v < height_; ++v) {
      if (v < descriptor_rows.begin || v >= descriptor_rows.end) {
        std::fill_n(out.view().row(v), width_, std::int16_t{kNotSearched});
        continue;
      }
      std::vector<std::uint16_t> sums;
      for (int u = 0; u < width_; ++u) {
        for (int i = 0; i < p.range.disparities; ++i)
          sums.push_back(static_cast<std::uint16_t>(window_sum(p, descriptor_rows, u, v, i)));
      }
      EXPECT_EQ(
          select_row_ref(sums, row_span(textured_.view(), v), p.range, p.select, scratch, row_span(out.view(), v)),
          Status::ok);
    }
    return out;
  }

 private:
  int window_sum(const BlockParams& p, Rows descriptor_rows, int u, int v, int i) const {
    int sum = 0;
    for (int y = v - p.radius_v; y <= v + p.radius_v; ++y) {
      for (int x = u - p.radius_u; x <= u + p.radius_u; ++x) {
        const bool counts = y >= descriptor_rows.begin && y < descriptor_rows.end && inside(p, x);
        const int other = x - p.range.first - i;
        if (counts && inside(p, other)) sum += Matcher::cost(left_.view().at(x, y), right_.view().at(other, y));
        if (counts && !inside(p, other)) sum += Matcher::outside(p.edge_cap);
      }
    }
    EXPECT_LE(sum, 65535);
    return sum;
  }

  static bool inside(const BlockParams& p, int u) { return u >= p.range.valid_begin && u < p.range.valid_end; }

  int width_;
  int height_;
  PaddedImage<Descriptor> left_;
  PaddedImage<Descriptor> right_;
  PaddedImage<std::uint8_t> textured_;
};

}  // namespace lakshya::test
