// Netpbm files written out by hand: app/core/image_pgm.cc.
#include <gtest/gtest.h>

#include "tests/support/image_checks.h"

namespace lakshya {
namespace {

using namespace std::string_literals;
using Pixels = std::vector<int>;

class ImagePgm : public testing::Test {
 protected:
  Image<std::uint8_t> read(const std::string& content) const { return read_gray(folder_.write("image", content)); }
  std::string why(const std::string& content) const { return gray_refusal(folder_.write("image", content)); }

 private:
  TempFolder folder_;
};

TEST_F(ImagePgm, BinaryGray) {
  const Image<std::uint8_t> image = read("P5\n3 2\n255\n\x00\x01\x02\x7f\x80\xff"s);
  EXPECT_EQ(image.width(), 3);
  EXPECT_EQ(image.height(), 2);
  EXPECT_EQ(pixels(image), (Pixels{0, 1, 2, 127, 128, 255}));
}

TEST_F(ImagePgm, SamplesThatLookLikeWhiteSpaceOrComments) {
  EXPECT_EQ(pixels(read("P5 3 1 255\n\n# "s)), (Pixels{'\n', '#', ' '}));
}

TEST_F(ImagePgm, CommentsAnywhereInTheHeader) {
  EXPECT_EQ(pixels(read("P5# a\n#b\r\n 2#3 4\n\t1 # 9\n255#end\nAB"s)), (Pixels{'A', 'B'}));
}

TEST_F(ImagePgm, AsciiGray) {
  EXPECT_EQ(pixels(read("P2\n2 2 255\n0 7 # and\n\t255\r\n 0099"s)), (Pixels{0, 7, 255, 99}));
}

TEST_F(ImagePgm, SmallMaxvalSpreadsOverAllOfTheRange) {
  EXPECT_EQ(pixels(read("P5 2 1 1\n\x00\x01"s)), (Pixels{0, 255}));
  // 255 * 1 / 100 = 2.55 and 255 * 50 / 100 = 127.5
  EXPECT_EQ(pixels(read("P2 4 1 100 0 1 50 100"s)), (Pixels{0, 3, 128, 255}));
}

TEST_F(ImagePgm, ColourBecomesLuma) {
  // (77*10 + 150*20 + 29*30 + 128) / 256 = 4768 / 256 = 18.6
  EXPECT_EQ(pixels(read("P6 4 1 255\n\xff\x00\x00\x00\xff\x00\x00\x00\xff\x0a\x14\x1e"s)),
            (Pixels{77, 149, 29, 18}));
  EXPECT_EQ(pixels(read("P3 2 1 255 10 20 30 200 200 200"s)), (Pixels{18, 200}));
  // maxval first, then luma: (0, 1, 0) of 1 is pure green.
  EXPECT_EQ(pixels(read("P3 1 1 1 0 1 0"s)), (Pixels{149}));
}

TEST_F(ImagePgm, WhatFollowsTheSamplesIsIgnored) {
  EXPECT_EQ(pixels(read("P5 1 1 255\nAP5 1 1 255\nB"s)), (Pixels{'A'}));
}

TEST_F(ImagePgm, EveryCutIsRefused) {
  const auto bytes = [](const std::string& s) { return FileBytes(s.begin(), s.end()); };
  expect_every_cut_refused(bytes("P5\n# comment\n3 2\n255\nabcdef"), gray_refusal);
  expect_every_cut_refused(bytes("P6 2 1 255\nabcdef"), gray_refusal);
  expect_every_cut_refused(bytes("P2 3 1 255\n10 20 3"), gray_refusal);  // one digit: no shorter number is left
  expect_every_cut_refused(bytes("P3 1 1 255\n10 20 3"), gray_refusal);
}

TEST_F(ImagePgm, RefusesBadHeaders) {
  EXPECT_CONTAINS(why("P5 0 2 255\nab"), "is empty");
  EXPECT_CONTAINS(why("P5 16385 1 255\nab"), "above 16384");
  EXPECT_CONTAINS(why("P5 99999999999999999999 1 255\nab"), "above 16384");
  EXPECT_CONTAINS(why("P5 16384 16384 255\nab"), "more than 128000000 pixels");
  EXPECT_CONTAINS(why("P5 -1 1 255\na"), "width is not a number");
  EXPECT_CONTAINS(why("P5 1 x 255\na"), "height is not a number");
  EXPECT_CONTAINS(why("P5 1 1 0\na"), "not 1..65535");
  EXPECT_CONTAINS(why("P5 1 1 65536\na"), "not 1..65535");
  EXPECT_CONTAINS(why("P5 1 1 255x"), "not followed by white space");
}

TEST_F(ImagePgm, RefusesSixteenBits) {
  EXPECT_CONTAINS(why("P5 1 1 256\nab"), "convert it to 8 bits");
  EXPECT_CONTAINS(why("P6 1 1 65535\nabcdef"), "convert it to 8 bits");
}

TEST_F(ImagePgm, RefusesBadSamples) {
  EXPECT_CONTAINS(why("P5 2 1 100\nd\x65"), "above maxval");  // 100 is allowed, 101 is not
  EXPECT_CONTAINS(why("P2 2 1 255 1 256"), "above maxval");
  EXPECT_CONTAINS(why("P2 2 1 255 1 -2"), "sample is not a number");
}

TEST_F(ImagePgm, RefusesAHugeClaimWithoutAllocatingIt) {
  EXPECT_CONTAINS(why("P5 16384 7000 255\nab"), "cut off");
  EXPECT_CONTAINS(why("P3 16384 7000 255\n1 2 3"), "cut off");
}

TEST_F(ImagePgm, DamageIsReadOrRefused) {
  for (const std::string& kind : {"P2 "s, "P3 "s, "P5 "s, "P6 "s}) {
    const std::string text = kind + "2 2 100\n10 20 30 40 50 60 70 80 90 11 12 13";
    EXPECT_GT(accepted_after_damage(FileBytes(text.begin(), text.end()), 500), 0);
  }
}

}  // namespace
}  // namespace lakshya
