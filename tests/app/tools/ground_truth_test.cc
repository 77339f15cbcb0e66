#include "app/tools/ground_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/image_checks.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

TEST(GroundTruthFormatText, IsReadOrRefused) {
  EXPECT_EQ(parse_ground_truth_format("pfm").kind, GroundTruthFormat::Kind::pfm);
  EXPECT_EQ(parse_ground_truth_format("kitti").scale, 256);
  EXPECT_EQ(parse_ground_truth_format("scaled:2.5").scale, 2.5);
  for (const char* wrong : {"", "png", "scaled", "scaled:", "scaled:0", "scaled:-1", "scaled:4x", "scaled:nan"}) {
    EXPECT_THROW((void)parse_ground_truth_format(wrong), std::invalid_argument) << wrong;
  }
}

class GroundTruth : public testing::Test {
 protected:
  std::string png16(std::initializer_list<std::uint16_t> values) const {
    Image<std::uint16_t> image(static_cast<int>(values.size()), 1);
    std::copy(values.begin(), values.end(), image.view().data);
    write_png(folder_.path("truth.png"), image.view());
    return folder_.path("truth.png");
  }
  TempFolder folder_;
};

TEST_F(GroundTruth, KittiIsInUnitsOf256thsAndZeroIsUnknown) {
  const Image<float> truth = read_ground_truth(png16({0, 256, 640}), parse_ground_truth_format("kitti"));
  EXPECT_EQ(truth.view().at(0, 0), kUnknownDisparity);
  EXPECT_EQ(truth.view().at(1, 0), 1.0F);
  EXPECT_EQ(truth.view().at(2, 0), 2.5F);
}

TEST_F(GroundTruth, ScaledHasItsOwnUnit) {
  const Image<float> truth = read_ground_truth(png16({0, 6, 12}), parse_ground_truth_format("scaled:4"));
  EXPECT_EQ(truth.view().at(0, 0), kUnknownDisparity);
  EXPECT_EQ(truth.view().at(2, 0), 3.0F);
}

TEST_F(GroundTruth, AbsurdFilesAreRefused) {
  const auto refused = [&](const std::string& path) {
    return refusal(path, [](const std::string& p) { read_ground_truth(p, parse_ground_truth_format("kitti")); });
  };
  EXPECT_CONTAINS(refused(png16({0, 0, 0})), "no pixel is known");
  EXPECT_CONTAINS(refused(png16({0, 256, 1025})), "in an image 3 px wide");
}

TEST_F(GroundTruth, MaskKeeps255Only) {
  Image<float> truth(3, 1, 5);
  Image<std::uint8_t> mask(3, 1);
  mask.view().at(0, 0) = 255;
  mask.view().at(1, 0) = 128;
  write_png(folder_.path("mask.png"), std::as_const(mask).view());
  apply_mask(folder_.path("mask.png"), truth);
  EXPECT_EQ(truth.view().at(0, 0), 5);
  EXPECT_EQ(truth.view().at(1, 0), kUnknownDisparity);
  EXPECT_EQ(truth.view().at(2, 0), kUnknownDisparity);
  Image<float> other(2, 1, 5);
  EXPECT_CONTAINS(refusal(folder_.path("mask.png"), [&](const std::string& path) { apply_mask(path, other); }),
                  "mask size: 3x1 differs");
}

// True 10 px everywhere but one unknown pixel; errors 0, 1, 1.5, 2.5, 3.5, 4.5 px, and one pixel without an estimate.
TEST(CompareDisparity, HandComputed) {
  const PaddedImage<std::int16_t> estimate(8, 1, {160, 176, 136, 200, 104, 232, -3, 160});
  PaddedImage<float> truth(8, 1, 3, 10.0F);
  truth.view().at(7, 0) = kUnknownDisparity;
  const DisparityErrors e = compare_disparity(estimate.view(), truth.view(), 0);
  EXPECT_EQ(e.truth_pixels, 7);
  EXPECT_DOUBLE_EQ(e.density, 6.0 / 7);
  EXPECT_DOUBLE_EQ(e.bad1, 4.0 / 6);
  EXPECT_DOUBLE_EQ(e.bad2, 3.0 / 6);
  EXPECT_DOUBLE_EQ(e.bad4, 1.0 / 6);
  EXPECT_DOUBLE_EQ(e.d1, 2.0 / 6);
  EXPECT_DOUBLE_EQ(e.average, 13.0 / 6);
  EXPECT_DOUBLE_EQ(e.wrong_or_missing2, 4.0 / 7);
  const DisparityErrors right = compare_disparity(estimate.view(), truth.view(), 6);
  EXPECT_EQ(right.truth_pixels, 1);
  EXPECT_EQ(right.density, 0);
  EXPECT_TRUE(std::isnan(right.bad2));
  EXPECT_EQ(right.wrong_or_missing2, 1);
}

// 3.5 px of 100 px are no outlier of D1: both limits must be passed.
TEST(CompareDisparity, D1IsRelativeToo) {
  const PaddedImage<std::int16_t> estimate(2, 1, {1656, 1704});  // 103.5, 106.5
  const PaddedImage<float> truth(2, 1, 3, 100.0F);
  EXPECT_DOUBLE_EQ(compare_disparity(estimate.view(), truth.view(), 0).d1, 0.5);
}

}  // namespace
}  // namespace lakshya
