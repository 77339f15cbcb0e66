#include "hal/camera/v4l2_frame.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/eye_pair.h"
#include "tests/support/jpeg_picture.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

using Bytes = std::vector<std::uint8_t>;

Bytes counting(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(i * 7);
  return bytes;
}

class V4l2FrameTest : public testing::Test {
 protected:
  Status make(const V4l2Picture& picture, const Bytes& used) {
    return grey_picture(picture, used, memory_.view(), grey_);
  }
  V4l2Picture mjpg() const { return {V4l2Format::mjpg, 32, 16, 0}; }

  PaddedImage<std::uint8_t> memory_{32, 16};
  ImageView<const std::uint8_t> grey_;
  test::EyePair scene_{{.width = 16, .height = 16}};
  ImageView<const std::uint8_t> source_{scene_.side_by_side().data(), 32, 16};
};

TEST_F(V4l2FrameTest, GreyIsNotCopied) {
  const V4l2Picture picture{V4l2Format::grey, 32, 16, 40};
  const Bytes used = counting(15 * 40 + 32);
  ASSERT_EQ(grey_picture(picture, used, {}, grey_), Status::ok);
  EXPECT_EQ(grey_.data, used.data());
  EXPECT_EQ(grey_.stride, 40);
  EXPECT_EQ(&half(grey_, 1).at(0, 2), &used[96]);
  EXPECT_EQ(&half(grey_, 1).at(15, 15), &used.back());
  EXPECT_EQ(&half(grey_, 0).at(0, 0), used.data());
  EXPECT_EQ(half(grey_, 0).width, 16);
}

TEST_F(V4l2FrameTest, LumaOfYuyvIsEverySecondByte) {
  const V4l2Picture picture{V4l2Format::yuyv, 32, 16, 70};
  const Bytes used = counting(15 * 70 + 64);
  ASSERT_EQ(make(picture, used), Status::ok);
  EXPECT_EQ(grey_.at(0, 0), used[0]);
  EXPECT_EQ(grey_.at(1, 0), used[2]);
  EXPECT_EQ(grey_.at(31, 15), used[15 * 70 + 62]);
  EXPECT_TRUE(memory_.canaries_alive());
}

TEST_F(V4l2FrameTest, JpegInColourAndGreyWithAndWithoutTables) {
  for (const int subsampling : {TJSAMP_422, TJSAMP_420, TJSAMP_GRAY}) {
    const Bytes jpeg = test::jpeg_of(source_, subsampling);
    for (Bytes bytes : {jpeg, test::without_tables(jpeg)}) {
      bytes.resize(bytes.size() + 100);  // UVC cameras pad
      ASSERT_EQ(make(mjpg(), bytes), Status::ok) << subsampling;
      int sum = 0;
      for (int v = 0; v < 16; ++v) {
        for (int u = 0; u < 32; ++u)
          sum += std::abs(grey_.at(u, v) - source_.at(u, v));
      }
      EXPECT_LT(sum, 2 * 32 * 16) << subsampling;
      EXPECT_TRUE(memory_.canaries_alive());
    }
  }
  EXPECT_LT(test::without_tables(test::jpeg_of(source_)).size(), test::jpeg_of(source_).size() - 400);
}

TEST_F(V4l2FrameTest, ShortBuffersAreBadData) {
  const V4l2Picture grey{V4l2Format::grey, 32, 16, 40};
  const V4l2Picture yuyv{V4l2Format::yuyv, 32, 16, 64};
  EXPECT_EQ(picture_bytes(grey), 15U * 40 + 32);
  EXPECT_EQ(picture_bytes(yuyv), 16U * 64);
  EXPECT_EQ(make(grey, Bytes(15 * 40 + 31)), Status::bad_data);
  EXPECT_EQ(make(yuyv, Bytes(16 * 64 - 1)), Status::bad_data);
  EXPECT_EQ(make(grey, {}), Status::bad_data);
  EXPECT_EQ(make(mjpg(), {}), Status::bad_data);
}

// A cut through the last bits of the last block may leave them complete.
TEST_F(V4l2FrameTest, EveryCutOfAJpegIsBadData) {
  const Bytes jpeg = test::jpeg_of(source_);
  for (std::size_t size = 0; size + 3 < jpeg.size(); ++size) {
    const Bytes cut(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(make(mjpg(), cut), Status::bad_data) << size << " of " << jpeg.size();
  }
}

TEST_F(V4l2FrameTest, OtherJpegsAreBadData) {
  EXPECT_EQ(make(mjpg(), test::jpeg_of(source_, TJSAMP_422, 95, TJFLAG_PROGRESSIVE)), Status::bad_data);
  EXPECT_EQ(make(mjpg(), test::jpeg_of(half(source_, 0))), Status::bad_data);
  Bytes jpeg = test::jpeg_of(source_);
  jpeg[jpeg.size() / 2] = 0xFF;  // a marker in the middle of the scan
  jpeg[jpeg.size() / 2 + 1] = 0xD9;
  EXPECT_EQ(make(mjpg(), jpeg), Status::bad_data);
  EXPECT_EQ(make(mjpg(), counting(2000)), Status::bad_data);
}

// libjpeg-turbo would keep them.
TEST_F(V4l2FrameTest, TheTablesOfOnePictureDoNotDecodeTheNext) {
  const Bytes plain = test::without_tables(test::jpeg_of(source_));
  ASSERT_EQ(make(mjpg(), plain), Status::ok);
  const Bytes before(grey_.row(0), grey_.row(0) + 32);
  Bytes strange = test::jpeg_of(source_);
  for (std::size_t at = 2; at + 4 < strange.size() && strange[at + 1] != 0xDA;
       at += 2 + (std::size_t{strange[at + 2]} << 8 | strange[at + 3])) {
    if (strange[at + 1] == 0xC4) std::swap(strange[at + 21], strange[at + 22]);  // two values of a Huffman table
  }
  (void)make(mjpg(), strange);
  ASSERT_EQ(make(mjpg(), plain), Status::ok);
  EXPECT_EQ(Bytes(grey_.row(0), grey_.row(0) + 32), before);
}

TEST_F(V4l2FrameTest, ImpossiblePicturesAreRefused) {
  const Bytes much(100000);
  for (const V4l2Picture& picture :
       {V4l2Picture{V4l2Format::grey, 32, 16, 31}, V4l2Picture{V4l2Format::yuyv, 32, 16, 63},
        V4l2Picture{V4l2Format::yuyv, 31, 16, 64}, V4l2Picture{V4l2Format::grey, 8, 16, 32},
        V4l2Picture{V4l2Format::grey, 32, -1, 32}, V4l2Picture{V4l2Format::mjpg, 20000, 16, 0},
        V4l2Picture{V4l2Format::grey, 32, 16, 1 << 20}}) {
    EXPECT_FALSE(is_possible(picture));
    EXPECT_EQ(make(picture, much), Status::bad_argument);
  }
  EXPECT_EQ(make({V4l2Format::yuyv, 64, 16, 128}, much), Status::bad_argument);  // the memory is of another size
}

TEST_F(V4l2FrameTest, OnlyTheJpegLibraryAllocates) {
  const V4l2Picture yuyv{V4l2Format::yuyv, 32, 16, 64};
  const Bytes used = counting(std::size_t{16} * 64);
  const Bytes jpeg = test::jpeg_of(source_);
  const int before = test::allocations;
  EXPECT_EQ(make(yuyv, used), Status::ok);
  EXPECT_EQ(make(mjpg(), jpeg), Status::ok);  // not by operator new
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya
