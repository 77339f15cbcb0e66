// JPEG files made by libjpeg-turbo: app/core/image_jpeg.cc.
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "tests/support/image_checks.h"

namespace lakshya {
namespace {

constexpr int kWidth = 37;  // no multiple of a block
constexpr int kHeight = 21;

// Smooth, so that compression changes little.
int ramp(int u, int v) {
  return 3 * u + 4 * v + 20;
}

FileBytes compress(const FileBytes& samples, int pixel_format, int subsampling, int flags = 0) {
  const tjhandle handle = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(
      tjCompress2(handle, samples.data(), kWidth, 0, kHeight, pixel_format, &data, &size, subsampling, 95, flags),
      0)
      << tjGetErrorStr2(handle);
  FileBytes bytes(data, data + size);
  tjFree(data);
  tjDestroy(handle);
  return bytes;
}

FileBytes gray_jpeg(int flags = 0) {
  FileBytes samples;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      samples.push_back(static_cast<std::uint8_t>(ramp(u, v)));
    }
  }
  return compress(samples, TJPF_GRAY, TJSAMP_GRAY, flags);
}

// (r, g, b) = (ramp, 100, 50): luma follows from BT.601.
FileBytes colour_jpeg(int subsampling) {
  FileBytes samples;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      for (const int sample : {ramp(u, v), 100, 50}) {
        samples.push_back(static_cast<std::uint8_t>(sample));
      }
    }
  }
  return compress(samples, TJPF_RGB, subsampling);
}

template <class Expected>
void expect_near(const Image<std::uint8_t>& image, Expected expected) {
  ASSERT_EQ(image.width(), kWidth);
  ASSERT_EQ(image.height(), kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_NEAR(image.view().at(u, v), expected(u, v), 4) << u << ' ' << v;
    }
  }
}

// Where the entropy-coded data of the (first) scan begin: behind the start-of-scan segment.
std::size_t scan_begin(const FileBytes& bytes) {
  for (std::size_t i = 2; i + 3 < bytes.size();) {
    const std::size_t next = i + 2 + static_cast<std::size_t>(bytes[i + 2]) * 256 + bytes[i + 3];
    if (bytes[i + 1] == 0xDA) return next;
    i = next;
  }
  ADD_FAILURE() << "no scan";
  return 0;
}

TEST(ImageJpeg, Gray) {
  const TempFolder folder;
  expect_near(read_gray(folder.write("gray.jpg", gray_jpeg())), ramp);
  expect_near(read_gray(folder.write("progressive.jpg", gray_jpeg(TJFLAG_PROGRESSIVE))), ramp);
}

TEST(ImageJpeg, ColourGivesItsLuma) {
  const TempFolder folder;
  const auto expected = [](int u, int v) { return 0.299 * ramp(u, v) + 0.587 * 100 + 0.114 * 50; };
  for (const int subsampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420}) {
    expect_near(read_gray(folder.write("colour.jpg", colour_jpeg(subsampling))), expected);
  }
}

TEST(ImageJpeg, EveryCutIsRefused) {
  expect_every_cut_refused(gray_jpeg(), gray_refusal);
  expect_every_cut_refused(gray_jpeg(TJFLAG_PROGRESSIVE), gray_refusal);
  expect_every_cut_refused(colour_jpeg(TJSAMP_420), gray_refusal);
}

TEST(ImageJpeg, DataThatEndBeforeTheEndMarkerAreRefused) {
  const TempFolder folder;
  const FileBytes whole = gray_jpeg();
  for (std::size_t end = scan_begin(whole) + 1; end + 4 < whole.size(); ++end) {
    FileBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(end));
    if (whole[end - 1] == 0xFF) continue;  // half of a stuffed byte: the end marker would not be one
    cut.insert(cut.end(), {0xFF, 0xD9});
    EXPECT_CONTAINS(gray_refusal(folder.write("cut.jpg", cut)), "jpeg: ") << end;
  }
}

TEST(ImageJpeg, RefusesCmyk) {
  const TempFolder folder;
  const FileBytes cmyk = compress(FileBytes(std::size_t{4} * kWidth * kHeight, 100), TJPF_CMYK, TJSAMP_444);
  EXPECT_CONTAINS(gray_refusal(folder.write("cmyk.jpg", cmyk)), "CMYK");
}

TEST(ImageJpeg, RefusesAHugeClaimWithoutAllocatingIt) {
  const TempFolder folder;
  FileBytes bytes = gray_jpeg();
  std::size_t frame = 2;  // the baseline frame header, FF C0: length 2, precision 1, height 2, width 2
  while (bytes[frame + 1] != 0xC0) {
    frame += 2 + static_cast<std::size_t>(bytes[frame + 2]) * 256 + bytes[frame + 3];
  }
  const auto claim = [&](int width, int height) {
    bytes[frame + 5] = static_cast<std::uint8_t>(height >> 8);
    bytes[frame + 6] = static_cast<std::uint8_t>(height);
    bytes[frame + 7] = static_cast<std::uint8_t>(width >> 8);
    bytes[frame + 8] = static_cast<std::uint8_t>(width);
    return gray_refusal(folder.write("claim.jpg", bytes));
  };
  EXPECT_EQ(claim(kWidth, kHeight), "");
  EXPECT_CONTAINS(claim(16384, 7000), "too short for its 16384 x 7000 pixels");
  EXPECT_CONTAINS(claim(16384, 16384), "more than 128000000 pixels");
  EXPECT_CONTAINS(claim(60000, 10), "above 16384");
  EXPECT_CONTAINS(claim(0, 10), "jpeg: ");
}

TEST(ImageJpeg, NotForSixteenBits) {
  const TempFolder folder;
  EXPECT_CONTAINS(gray16_refusal(folder.write("gray.jpg", gray_jpeg())), "not a PNG image");
}

TEST(ImageJpeg, DamageIsReadOrRefused) {
  EXPECT_GT(accepted_after_damage(gray_jpeg(), 2000), 0);
  EXPECT_GT(accepted_after_damage(colour_jpeg(TJSAMP_420), 500), 0);
  accepted_after_damage(gray_jpeg(TJFLAG_PROGRESSIVE), 500);
}

}  // namespace
}  // namespace lakshya
