#include "app/tools/disparity_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/base/units.h"
#include "kernels/prune/prune.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using StoredImage = test::PaddedImage<std::int16_t>;
using Codes = std::vector<int>;

// One row of stored disparities as it is in the file.
struct Written {
  Codes codes;
  int clipped = 0;
};
Written written(std::initializer_list<std::int16_t> stored, double doffs) {
  const StoredImage image(static_cast<int>(stored.size()), 1, stored);
  const KittiDisparity kitti = kitti_disparity(image.view(), doffs);
  const ImageView<const std::uint16_t> view = kitti.image.view();
  EXPECT_EQ(view.height, 1);
  return {Codes(view.data, view.data + view.width), kitti.clipped};
}

TEST(KittiDisparity, SixteenCodesPerSixteenthOfAPixel) {
  const Written row = written({1, 16, 17, 8 * 16, 4095}, 0);
  EXPECT_EQ(row.codes, (Codes{16, 256, 272, 2048, 65520}));
  EXPECT_EQ(row.clipped, 0);
}

TEST(KittiDisparity, ValidZeroIsOne) {
  const Written row = written({0}, 0);
  EXPECT_EQ(row.codes, Codes{1});
  EXPECT_EQ(row.clipped, 0);
}

TEST(KittiDisparity, EveryReasonIsNone) {
  const Written row =
      written({kNotSearched, kLowTexture, kNotUnique, kLeftRightFailed, kNoSupport, kPrunedEarly}, -3.5);
  EXPECT_EQ(row.codes, (Codes{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(row.clipped, 0);
}

TEST(KittiDisparity, DoffsIsTakenOff) {
  // 10 px stored with doffs 1.5 px: 8.5 px between the images.
  EXPECT_EQ(written({160}, 1.5).codes, Codes{8 * 256 + 128});
  EXPECT_EQ(written({160}, -1.5).codes, Codes{11 * 256 + 128});
  // Stored disparities carry doffs in 1/16 px: 0.04 px is 1/16, 0.03 px is none.
  EXPECT_EQ(written({160}, 0.04).codes, Codes{159 * 16});
  EXPECT_EQ(written({160}, 0.03).codes, Codes{160 * 16});
}

TEST(KittiDisparity, CountsWhatSixteenBitsCannotHold) {
  const Written low = written({0, 23, 24, 25}, 1.5);
  EXPECT_EQ(low.codes, (Codes{1, 1, 1, 16}));
  EXPECT_EQ(low.clipped, 2);
  const Written high = written({4095, 4096, 8000}, 0);
  EXPECT_EQ(high.codes, (Codes{65520, 65535, 65535}));
  EXPECT_EQ(high.clipped, 2);
  EXPECT_EQ(written({32767}, -100000.0).codes, Codes{65535});
}

TEST(KittiDisparity, KeepsTheShape) {
  const StoredImage stored(3, 2, {16, 32, 48, -1, 80, 96});
  const KittiDisparity kitti = kitti_disparity(stored.view(), 0);
  ASSERT_EQ(kitti.image.width(), 3);
  ASSERT_EQ(kitti.image.height(), 2);
  EXPECT_EQ(kitti.image.view().at(0, 1), 0);
  EXPECT_EQ(kitti.image.view().at(2, 1), 6 * 256);
  EXPECT_EQ(kitti_disparity({}, 0).image.width(), 0);
}

// f B = 10 px m, camera 1 m above the ground, level, 0.2 m ahead of and 0.1 m left of the turning centre.
class PlyPoints : public ::testing::Test {
 protected:
  PlyPoints() {
    const PruneGeometry geometry{.focal_px = 100,
                                 .baseline_m = 0.1,
                                 .center_u = 1,
                                 .center_v = 0,
                                 .height_m = 1,
                                 .forward_m = 0.2,
                                 .left_m = 0.1,
                                 .max_disparity_px = 64};
    const Status status = build_prune_model(geometry, depth_, height_, model_);
    EXPECT_EQ(status, Status::ok);
  }

  std::string ply() const {
    FrameResult frame;
    frame.disparity = disparity_.view();
    frame.classes = classes_.view();
    return ply_points(frame, model_);
  }

  std::vector<std::int32_t> depth_ = std::vector<std::int32_t>(prune_table_entries(64));
  std::vector<std::int32_t> height_ = depth_;
  PruneModel model_;
  StoredImage disparity_{3, 2, {80, 80, 80, 160, 4, -1}};
  test::PaddedImage<PixelClass> classes_{3, 2, 5, PixelClass::no_disparity};
};

constexpr std::size_t kVertexBytes = 15;

const std::string kHeader =
    "ply\nformat binary_little_endian 1.0\ncomment body frame: x forward, y left, z up, metres\n"
    "element vertex 3\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";

float float_at(const std::string& bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i-- > 0;)
    bits = bits << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return std::bit_cast<float>(bits);
}

TEST_F(PlyPoints, OneVertexForEveryPixelWithAPlace) {
  classes_.view().at(0, 0) = PixelClass::obstacle;
  classes_.view().at(1, 0) = PixelClass::no_disparity;  // a disparity from which nothing was concluded
  classes_.view().at(2, 0) = PixelClass::ceiling;
  classes_.view().at(0, 1) = PixelClass::floor;
  classes_.view().at(1, 1) = PixelClass::too_far;
  const std::string file = ply();
  ASSERT_EQ(file.substr(0, kHeader.size()), kHeader);
  ASSERT_EQ(file.size(), kHeader.size() + 3 * kVertexBytes);

  // 5 px: 2 m away, 0.02 m for every pixel from the centre. 10 px: 1 m away, one row down is 0.01 m down.
  const std::array<std::array<float, 3>, 3> points{
      {{2.2F, 0.12F, 1.0F}, {2.2F, 0.08F, 1.0F}, {1.2F, 0.11F, 0.99F}}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(float_at(file, kHeader.size() + i * kVertexBytes + 4 * axis), points[i][axis], 1e-6F)
          << "vertex " << i << ", axis " << axis;
    }
  }
}

TEST_F(PlyPoints, BytesOfOneVertex) {
  disparity_.view().at(1, 0) = 80;
  classes_.view().at(1, 0) = PixelClass::obstacle;
  const std::string file = ply();
  const std::string expected(
      "\xCD\xCC\x0C\x40"  // 2.2
      "\xCD\xCC\xCC\x3D"  // 0.1
      "\x00\x00\x80\x3F"  // 1
      "\xD5\x5E\x00",
      kVertexBytes);
  EXPECT_NE(file.find("\nelement vertex 1\n"), std::string::npos);
  EXPECT_EQ(file.substr(file.size() - kVertexBytes), expected);
}

TEST_F(PlyPoints, ClassesHaveTheirOwnColours) {
  constexpr std::array kPlaced{PixelClass::obstacle, PixelClass::floor, PixelClass::ceiling, PixelClass::drop_off};
  std::vector<std::string> colours;
  for (const PixelClass c : kPlaced) {
    classes_.view().at(1, 0) = c;
    const std::string file = ply();
    const std::string colour = file.substr(file.size() - 3);
    EXPECT_EQ(std::count(colours.begin(), colours.end(), colour), 0);
    colours.push_back(colour);
  }
}

TEST_F(PlyPoints, NoPointsIsAValidFile) {
  const std::string file = ply();
  EXPECT_NE(file.find("\nelement vertex 0\n"), std::string::npos);
  EXPECT_TRUE(file.ends_with("\nend_header\n"));
}

}  // namespace
}  // namespace lakshya
