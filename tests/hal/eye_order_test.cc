#include "hal/camera/eye_order.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/eye_pair.h"

namespace lakshya {
namespace {

using test::EyePair;
using test::EyePairShape;

class EyeOrderTest : public testing::Test {
 protected:
  void expect_right(const EyePairShape& shape) {
    const EyePair pair(shape);
    const EyeVotes as_is = finder_->look(pair.left(), pair.right());
    EXPECT_EQ(as_is.order, EyeOrder::left_first) << as_is.left_first << " : " << as_is.right_first;
    const EyeVotes swapped = finder_->look(pair.right(), pair.left());
    EXPECT_EQ(swapped.order, EyeOrder::right_first) << swapped.left_first << " : " << swapped.right_first;
  }

  std::unique_ptr<EyeOrderFinder> finder_ = std::make_unique<EyeOrderFinder>();
};

TEST_F(EyeOrderTest, TheSignOfTheDisparityTells) {
  expect_right({});
  expect_right({.seed = 2});
  expect_right({.width = 161, .height = 97, .top_px = 2, .bottom_px = 12});
  expect_right({.width = 1280, .height = 960, .top_px = 10, .bottom_px = 120});
}

TEST_F(EyeOrderTest, EyesSomeRowsApartAndOfOtherBrightness) {
  expect_right({.rows_apart = 7});
  expect_right({.rows_apart = -9});
  expect_right({.right_gain = 0.7, .right_offset = 40});
  const EyePair pair({.rows_apart = 7});
  EXPECT_EQ(finder_->look(pair.left(), pair.right()).rows_apart, 7);
}

TEST_F(EyeOrderTest, WhereLensesSquintTheRowsDecide) {
  const EyePairShape squinting{.top_px = -12, .bottom_px = 10};
  expect_right(squinting);
  const EyePair pair(squinting);
  const EyeVotes votes = finder_->look(pair.left(), pair.right());
  EXPECT_LT(votes.left_first, 2 * votes.right_first);  // the sides would have decided otherwise, or not at all
}

TEST_F(EyeOrderTest, ASurfaceThatMovesTheWrongWayWithoutNearAndFarIsBelieved) {
  const EyePair pair({.top_px = -8, .bottom_px = -8});
  EXPECT_EQ(finder_->look(pair.left(), pair.right()).order, EyeOrder::right_first);
}

TEST_F(EyeOrderTest, WhereThereIsNothingToSeeItIsUnsure) {
  constexpr std::size_t kPixels = std::size_t{320} * 240;
  const std::vector<std::uint8_t> flat(kPixels, 90);
  const ImageView<const std::uint8_t> view(flat.data(), 320, 240);
  EXPECT_EQ(finder_->look(view, view).order, EyeOrder::unsure);

  const EyePair pair({});
  EXPECT_EQ(finder_->look(pair.left(), pair.left()).order, EyeOrder::unsure);  // one camera twice
  EXPECT_GT(finder_->look(pair.left(), pair.left()).still, 100);

  const EyePair other({.seed = 77});
  EXPECT_EQ(finder_->look(pair.left(), other.right()).order, EyeOrder::unsure);  // two cameras of two places

  std::mt19937 random(3);
  std::vector<std::uint8_t> noise(2 * kPixels);
  for (std::uint8_t& pixel : noise)
    pixel = static_cast<std::uint8_t>(random());
  EXPECT_EQ(finder_->look({noise.data(), 320, 240}, {noise.data() + kPixels, 320, 240}).order, EyeOrder::unsure);
}

TEST_F(EyeOrderTest, ImagesThatAreNoPairAreUnsure) {
  const EyePair pair({});
  ImageView<const std::uint8_t> narrow = pair.right();
  narrow.width -= 1;
  EXPECT_EQ(finder_->look(pair.left(), narrow).order, EyeOrder::unsure);
  EXPECT_EQ(finder_->look({}, {}).order, EyeOrder::unsure);
  const EyePair flat({.width = 1600, .height = 40});
  EXPECT_EQ(finder_->look(flat.left(), flat.right()).order, EyeOrder::unsure);
  const EyePair small({.width = 32, .height = 32});
  EXPECT_EQ(finder_->look(small.left(), small.right()).order, EyeOrder::unsure);
}

TEST_F(EyeOrderTest, AllocatesNothing) {
  const EyePair pair({});
  const int before = test::allocations;
  EXPECT_EQ(finder_->look(pair.left(), pair.right()).order, EyeOrder::left_first);
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya
