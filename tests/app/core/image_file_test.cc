// What concerns every format, and files from real cameras. Formats: image_png_test, image_pgm_test,
// image_jpeg_test.
#include "app/core/image_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/core/image_codecs.h"
#include "tests/support/image_checks.h"

namespace lakshya {
namespace {

using namespace std::string_literals;

TEST(ImageFile, LumaKeepsGrayAndEndsOfRange) {
  for (int v = 0; v < 256; ++v) {
    EXPECT_EQ(luma(v, v, v), v);
  }
  EXPECT_EQ(luma(255, 0, 0), 77);   // (77*255 + 128) >> 8 = 19763 >> 8
  EXPECT_EQ(luma(0, 255, 0), 149);  // 38378 >> 8
  EXPECT_EQ(luma(0, 0, 255), 29);   // 7523 >> 8
}

TEST(ImageFile, SizeLimits) {
  EXPECT_NO_THROW(check_image_size("f", 1, 1));
  EXPECT_NO_THROW(check_image_size("f", 16384, 7812));  // 127 991 808
  EXPECT_THROW(check_image_size("f", 16384, 7813), InputError);
  EXPECT_THROW(check_image_size("f", 16385, 1), InputError);
  EXPECT_THROW(check_image_size("f", 1, 16385), InputError);
  EXPECT_THROW(check_image_size("f", 0, 1), InputError);
  EXPECT_THROW(check_image_size("f", 1, -1), InputError);
}

TEST(ImageFile, RefusesWhatIsNoImage) {
  const TempFolder folder;
  for (const std::string& content :
       {"hello"s, "x"s, "\x89PNG"s, "BM0000000000"s, "P4 1 1 0"s, "P7\nWIDTH 1"s, "P5"s, "\xff\xd8"s}) {
    EXPECT_CONTAINS(gray_refusal(folder.write("file.png", content)), "not a PNG, PGM, PPM or JPEG image");
    EXPECT_CONTAINS(gray16_refusal(folder.write("file.png", content)), "not a PNG image");
  }
  EXPECT_CONTAINS(gray_refusal(folder.path("none.png")), "does not exist");
  EXPECT_CONTAINS(gray_refusal(folder.path("")), "is a directory");
  EXPECT_CONTAINS(gray_refusal(folder.write("empty.png", ""s)), "is empty");
  EXPECT_CONTAINS(gray16_refusal(folder.path("none.png")), "does not exist");
}

TEST(ImageFile, ContentDecidesNotTheName) {
  const TempFolder folder;
  EXPECT_EQ(pixels(read_gray(folder.write("pgm.png", "P5 2 1 255\nAB"s))), (std::vector<int>{'A', 'B'}));
}

class RealImages : public testing::Test {
 protected:
  // Empty when the data are not on this machine.
  static std::string file(const std::string& name) {
    const char* data = std::getenv("LAKSHYA_DATA");
    const std::string path = data == nullptr ? "" : data + ("/" + name);
    return std::filesystem::exists(path) ? path : "";
  }
};

TEST_F(RealImages, Jpeg) {
  const std::string path = file("middlebury/aloe/left.jpg");
  if (path.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no middlebury/aloe/left.jpg";
  const Image<std::uint8_t> image = read_gray(path);
  EXPECT_EQ(image.width(), 1282);
  EXPECT_EQ(image.height(), 1110);
}

TEST_F(RealImages, GrayPng) {
  const std::string path = file("kitti2012/left/000006_10.png");
  if (path.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no kitti2012/left/000006_10.png";
  const Image<std::uint8_t> image = read_gray(path);
  EXPECT_EQ(image.width(), 1242);
  EXPECT_EQ(image.height(), 375);
}

TEST_F(RealImages, ColourPng) {
  const std::string path = file("middlebury/tsukuba/left.png");
  if (path.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no middlebury/tsukuba/left.png";
  const Image<std::uint8_t> image = read_gray(path);
  EXPECT_EQ(image.width(), 384);
  EXPECT_EQ(image.height(), 288);
}

TEST_F(RealImages, DisparityPng) {
  const std::string path = file("kitti2012/disp_noc/000006_10.png");
  if (path.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no kitti2012/disp_noc/000006_10.png";
  const Image<std::uint16_t> image = read_gray16(path);
  EXPECT_EQ(image.width(), 1242);
  EXPECT_EQ(image.height(), 375);
  int known = 0;
  for (const int d256 : pixels(image)) {
    if (d256 == 0) continue;
    ++known;
    ASSERT_LT(d256, 256 * 256);  // KITTI: disparity * 256, at most 255 px
  }
  EXPECT_GT(known, 1242 * 375 / 10);
  EXPECT_CONTAINS(gray_refusal(path), "16-bit");
}

}  // namespace
}  // namespace lakshya
