// Portable float maps written out by hand: app/core/image_pfm.cc.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/image_checks.h"

namespace lakshya {
namespace {

using namespace std::string_literals;

class ImagePfm : public testing::Test {
 protected:
  Image<float> read(const std::string& content) const { return read_pfm(folder_.write("a.pfm", content)); }
  std::string why(const std::string& content) const {
    return refusal(folder_.write("a.pfm", content), [](const std::string& path) { read_pfm(path); });
  }

 private:
  TempFolder folder_;
};

// 1.0f is 3f800000, -2.5f c0200000, 0.5f 3f000000, infinity 7f800000.
TEST_F(ImagePfm, RowsAreBottomUpAndTheSignIsTheByteOrder) {
  const std::string little = "\0\0\x80\x3f\0\0\x20\xc0\0\0\0\x3f\0\0\x80\x7f"s;
  const Image<float> image = read("Pf\n2 2\n-1.0\n" + little);
  EXPECT_EQ(image.view().at(0, 1), 1.0F);
  EXPECT_EQ(image.view().at(1, 1), -2.5F);
  EXPECT_EQ(image.view().at(0, 0), 0.5F);
  EXPECT_TRUE(std::isinf(image.view().at(1, 0)));
  EXPECT_EQ(read("Pf\n1 1\n1\n\x3f\x80\0\0"s).view().at(0, 0), 1.0F);
}

TEST_F(ImagePfm, TheSizeOfTheScaleIsIgnored) {
  EXPECT_EQ(read("Pf 1 1 -0.003922\n\0\0\x80\x3f"s).view().at(0, 0), 1.0F);
}

TEST_F(ImagePfm, SamplesThatLookLikeWhiteSpace) {
  EXPECT_EQ(read("Pf 1 1 -1\n\n \t\r"s).view().at(0, 0), std::bit_cast<float>(0x0d09200aU));
}

TEST_F(ImagePfm, Refusals) {
  EXPECT_CONTAINS(why("PF 1 1 -1\nabcdabcdabcd"), "three channels");
  EXPECT_CONTAINS(why("P5 1 1 255\na"), "does not start with Pf");
  EXPECT_CONTAINS(why("Pf 0 1 -1\nabcd"), "is empty");
  EXPECT_CONTAINS(why("Pf 99999 1 -1\nabcd"), "above 16384");
  EXPECT_CONTAINS(why("Pf 99999999999999999999 1 -1\nabcd"), "width '99999999999999999999' is not a number");
  EXPECT_CONTAINS(why("Pf 1 x -1\nabcd"), "height 'x' is not a number");
  EXPECT_CONTAINS(why("Pf 1 1 0\nabcd"), "scale is 0");
  EXPECT_CONTAINS(why("Pf 1 1 nan\nabcd"), "scale is 0 or not finite");
  EXPECT_CONTAINS(why("Pf 1 1 -1\nabc"), "has 3 bytes of samples, its header says 4");
  EXPECT_CONTAINS(why("Pf 1 1 -1\nabcde"), "has 5 bytes of samples");
  EXPECT_CONTAINS(why("Pf 1 1"), "height is missing");
  EXPECT_CONTAINS(why("Pf 16384 7000 -1\nabcd"), "cut off");
}

}  // namespace
}  // namespace lakshya
