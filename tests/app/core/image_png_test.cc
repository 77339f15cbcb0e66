// PNG files, ours and libpng's: app/core/image_png.cc.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <filesystem>

#include "app/core/file_bytes.h"
#include "tests/support/image_checks.h"

namespace lakshya {
namespace {

using Pixels = std::vector<int>;

struct PngSpec {
  int color_type = PNG_COLOR_TYPE_GRAY;
  int bit_depth = 8;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<png_color> palette = {};
  double gamma = 0;
  bool transparency = false;
};

// A PNG of any kind; `rows` as the file holds them, packed and big-endian. libpng's default error handler would
// abort, which no well-formed spec reaches.
FileBytes make_png(int width, const PngSpec& spec, std::vector<FileBytes> rows) {
  FileBytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp to, png_bytep data, std::size_t size) {
    auto& all = *static_cast<FileBytes*>(png_get_io_ptr(to));
    all.insert(all.end(), data, data + size);
  };
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), spec.bit_depth,
               spec.color_type, spec.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!spec.palette.empty()) png_set_PLTE(png, info, spec.palette.data(), static_cast<int>(spec.palette.size()));
  if (spec.gamma > 0) png_set_gAMA(png, info, spec.gamma);
  if (spec.transparency) {
    const png_byte alpha[] = {0, 128};
    const png_color_16 color = {0, 1, 1, 1, 1};
    png_set_tRNS(png, info, alpha, spec.palette.empty() ? 0 : 2, &color);
  }
  std::vector<png_bytep> pointers;
  pointers.reserve(rows.size());
  for (FileBytes& row : rows) {
    pointers.push_back(row.data());
  }
  png_set_rows(png, info, pointers.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::uint32_t big_endian(const FileBytes& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
         bytes[at + 3];
}

void put_big_endian(FileBytes& bytes, std::size_t at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) {
    bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  }
}

// PNG specification, annex D: reflected polynomial EDB88320 over type and data.
std::uint32_t crc(const FileBytes& bytes, std::size_t begin, std::size_t end) {
  std::uint32_t c = 0xFFFFFFFF;
  for (std::size_t i = begin; i < end; ++i) {
    c ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) {
      c = (c >> 1) ^ ((c & 1) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~c;
}

void repair_checksums(FileBytes& bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t end = at + 8 + big_endian(bytes, at);
    if (end + 4 > bytes.size()) return;
    put_big_endian(bytes, end, crc(bytes, at + 4, end));
    at = end + 4;
  }
}

class ImagePng : public testing::Test {
 protected:
  Image<std::uint8_t> read(const FileBytes& bytes) const { return read_gray(folder_.write("image", bytes)); }
  std::string file(const FileBytes& bytes) const { return folder_.write("image", bytes); }
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string why(const FileBytes& bytes) const { return gray_refusal(folder_.write("image", bytes)); }
  std::string why16(const FileBytes& bytes) const { return gray16_refusal(folder_.write("image", bytes)); }
  FileBytes content(const std::string& name) const { return read_file(path(name), 1U << 20); }

 private:
  TempFolder folder_;
};

template <class T>
Image<T> noise(int width, int height) {
  std::mt19937 random(1);  // the same image every time
  Image<T> image(width, height);
  const auto area = static_cast<std::ptrdiff_t>(width) * height;
  std::generate_n(image.view().data, area, [&] { return static_cast<T>(random()); });
  return image;
}

TEST_F(ImagePng, RoundTripOf8Bits) {
  for (const int width : {1, 2, 7, 8, 9, 33}) {
    const Image<std::uint8_t> image = noise<std::uint8_t>(width, 5);
    write_png(path("gray.png"), image.view());
    const Image<std::uint8_t> back = read_gray(path("gray.png"));
    ASSERT_EQ(back.width(), width);
    ASSERT_EQ(back.height(), 5);
    EXPECT_EQ(pixels(back), pixels(image));
    EXPECT_EQ(pixels(read_gray16(path("gray.png"))), pixels(image));
  }
}

TEST_F(ImagePng, RoundTripOf16Bits) {
  const Image<std::uint16_t> image = noise<std::uint16_t>(13, 6);
  write_png(path("deep.png"), image.view());
  const Image<std::uint16_t> back = read_gray16(path("deep.png"));
  ASSERT_EQ(back.width(), 13);
  ASSERT_EQ(back.height(), 6);
  EXPECT_EQ(pixels(back), pixels(image));
}

TEST_F(ImagePng, SixteenBitsAreBigEndianInTheFile) {
  Image<std::uint16_t> image(1, 1, 0x1234);
  write_png(path("ours.png"), image.view());
  EXPECT_EQ(content("ours.png"), make_png(1, {.bit_depth = 16}, {{0x12, 0x34}}));
}

TEST_F(ImagePng, ColourIsWrittenAsRgbAndReadAsLuma) {
  Image<Rgb8> image(4, 1);
  image.view().at(0, 0) = {255, 0, 0};
  image.view().at(1, 0) = {0, 255, 0};
  image.view().at(2, 0) = {0, 0, 255};
  image.view().at(3, 0) = {10, 20, 30};
  write_png(path("rgb.png"), image.view());
  const FileBytes row = {255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30};
  EXPECT_EQ(content("rgb.png"), make_png(4, {.color_type = PNG_COLOR_TYPE_RGB}, {row}));
  EXPECT_EQ(pixels(read_gray(path("rgb.png"))), (Pixels{77, 149, 29, 18}));
}

TEST_F(ImagePng, AViewOfAPartIsWrittenWithItsStride) {
  Image<std::uint8_t> image(3, 2);
  for (int i = 0; i < 6; ++i) {
    image.view().data[i] = static_cast<std::uint8_t>(i);
  }
  write_png(path("part.png"), ImageView<const std::uint8_t>(image.view().data + 1, 2, 2, 3));
  EXPECT_EQ(pixels(read_gray(path("part.png"))), (Pixels{1, 2, 4, 5}));
}

TEST_F(ImagePng, NarrowGraySpreadsOverAllOfTheRange) {
  EXPECT_EQ(pixels(read(make_png(3, {.bit_depth = 1}, {{0b10100000}}))), (Pixels{255, 0, 255}));
  EXPECT_EQ(pixels(read(make_png(5, {.bit_depth = 2}, {{0b00011011, 0b11000000}}))),
            (Pixels{0, 85, 170, 255, 255}));
  EXPECT_EQ(pixels(read(make_png(3, {.bit_depth = 4}, {{0x0F, 0x70}}))), (Pixels{0, 255, 119}));
}

TEST_F(ImagePng, PaletteIsExpanded) {
  PngSpec spec{.color_type = PNG_COLOR_TYPE_PALETTE, .palette = {{0, 255, 0}, {10, 20, 30}, {9, 9, 9}}};
  EXPECT_EQ(pixels(read(make_png(4, spec, {{2, 0, 1, 2}}))), (Pixels{9, 149, 18, 9}));
  spec.transparency = true;
  EXPECT_EQ(pixels(read(make_png(4, spec, {{2, 0, 1, 2}}))), (Pixels{9, 149, 18, 9}));
  spec.bit_depth = 2;
  EXPECT_EQ(pixels(read(make_png(4, spec, {{0b10000110}}))), (Pixels{9, 149, 18, 9}));
}

TEST_F(ImagePng, AlphaIsDropped) {
  EXPECT_EQ(pixels(read(make_png(2, {.color_type = PNG_COLOR_TYPE_GRAY_ALPHA}, {{7, 0, 200, 128}}))),
            (Pixels{7, 200}));
  const FileBytes rgba = {0, 255, 0, 0, 10, 20, 30, 99};
  EXPECT_EQ(pixels(read(make_png(2, {.color_type = PNG_COLOR_TYPE_RGB_ALPHA}, {rgba}))), (Pixels{149, 18}));
  EXPECT_EQ(pixels(read(make_png(2, {.transparency = true}, {{1, 2}}))), (Pixels{1, 2}));
  EXPECT_EQ(
      pixels(read(make_png(2, {.color_type = PNG_COLOR_TYPE_RGB, .transparency = true}, {{1, 1, 1, 2, 2, 2}}))),
      (Pixels{1, 2}));
}

TEST_F(ImagePng, GammaIsIgnored) {
  EXPECT_EQ(pixels(read(make_png(3, {.gamma = 1.0}, {{1, 100, 200}}))), (Pixels{1, 100, 200}));
}

TEST_F(ImagePng, InterlacedFilesHoldTheSamePixels) {
  const Image<std::uint8_t> image = noise<std::uint8_t>(33, 11);  // 11 rows of 33, or of 11 RGB pixels
  std::vector<FileBytes> rows;
  rows.reserve(11);
  for (int v = 0; v < 11; ++v) {
    rows.emplace_back(image.view().row(v), image.view().row(v) + 33);
  }
  PngSpec spec{.interlace = PNG_INTERLACE_ADAM7};
  EXPECT_EQ(pixels(read(make_png(33, spec, rows))), pixels(image));
  spec.color_type = PNG_COLOR_TYPE_RGB;
  const Image<std::uint8_t> interlaced = read(make_png(11, spec, rows));
  spec.interlace = PNG_INTERLACE_NONE;
  EXPECT_EQ(pixels(interlaced), pixels(read(make_png(11, spec, rows))));
}

TEST_F(ImagePng, SixteenBitsAreNotSilentlyHalved) {
  for (const int color_type :
       {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA}) {
    EXPECT_CONTAINS(why(make_png(1, {.color_type = color_type, .bit_depth = 16}, {FileBytes(8)})),
                    "convert it to 8 bits");
  }
}

TEST_F(ImagePng, Gray16TakesOnlyGrayOf16Or8Bits) {
  EXPECT_EQ(why16(make_png(2, {.bit_depth = 16, .interlace = PNG_INTERLACE_ADAM7}, {FileBytes(4)})), "");
  EXPECT_EQ(why16(make_png(2, {.transparency = true}, {FileBytes(2)})), "");
  EXPECT_CONTAINS(why16(make_png(2, {.bit_depth = 4}, {FileBytes(1)})), "not a grey image of 16 or 8 bits");
  for (const int color_type : {PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA}) {
    EXPECT_CONTAINS(why16(make_png(1, {.color_type = color_type, .bit_depth = 16}, {FileBytes(8)})),
                    "not a grey image");
  }
}

TEST_F(ImagePng, Gray16TakesGrayThatWasSavedAsColour) {
  const PngSpec gray_palette{.color_type = PNG_COLOR_TYPE_PALETTE, .palette = {{7, 7, 7}}};
  EXPECT_EQ(pixels(read_gray16(file(make_png(1, gray_palette, {FileBytes(1)})))), (std::vector<int>{7}));
  const PngSpec rgb{.color_type = PNG_COLOR_TYPE_RGB};
  EXPECT_EQ(pixels(read_gray16(file(make_png(2, rgb, {{9, 9, 9, 200, 200, 200}})))), (std::vector<int>{9, 200}));
  EXPECT_CONTAINS(why16(make_png(2, rgb, {{9, 9, 9, 200, 200, 201}})), "is a colour image");
  EXPECT_CONTAINS(why16(make_png(1, rgb, {{8, 9, 8}})), "is a colour image");
}

TEST_F(ImagePng, EveryCutIsRefused) {
  expect_every_cut_refused(make_png(3, {}, {{1, 2, 3}, {4, 5, 6}}), gray_refusal);
  expect_every_cut_refused(make_png(3, {.bit_depth = 16}, {FileBytes(6, 1), FileBytes(6, 2)}), gray16_refusal);
}

TEST_F(ImagePng, RefusesAbsurdSizes) {
  FileBytes bytes = make_png(1, {}, {{1}});
  const auto claim = [&](std::uint32_t width, std::uint32_t height) {
    put_big_endian(bytes, 16, width);
    put_big_endian(bytes, 20, height);
    repair_checksums(bytes);
    EXPECT_NE(why16(bytes), "");
    return why(bytes);
  };
  EXPECT_CONTAINS(claim(16384, 7000), "too short for its size");
  EXPECT_CONTAINS(claim(16384, 16384), "more than 128000000 pixels");
  EXPECT_CONTAINS(claim(0x7FFFFFFF, 0x7FFFFFFF), "above 16384");
  EXPECT_CONTAINS(claim(0, 1), "png: ");
  EXPECT_CONTAINS(claim(0xFFFFFFFF, 1), "png: ");
}

TEST_F(ImagePng, LargestCompressionIsNotMistakenForACut) {
  const Image<std::uint8_t> black(4000, 3000);
  write_png(path("black.png"), black.view());
  EXPECT_LT(std::filesystem::file_size(path("black.png")), 4000U * 3000 / 500);
  EXPECT_EQ(read_gray(path("black.png")).height(), 3000);
}

TEST_F(ImagePng, DamageIsReadOrRefused) {
  const FileBytes gray = make_png(9, {}, {FileBytes(9, 1), FileBytes(9, 2)});
  EXPECT_EQ(accepted_after_damage(gray, 500), 0);  // checksums see one to four bytes
  EXPECT_GT(accepted_after_damage(gray, 2000, repair_checksums), 0);
  const PngSpec palette{.color_type = PNG_COLOR_TYPE_PALETTE,
                        .bit_depth = 4,
                        .interlace = PNG_INTERLACE_ADAM7,
                        .palette = {{1, 2, 3}, {4, 5, 6}},
                        .transparency = true};
  EXPECT_GT(accepted_after_damage(make_png(9, palette, {FileBytes(5, 16), FileBytes(5)}), 2000, repair_checksums),
            0);
}

TEST_F(ImagePng, WritersRefuseBadSizesAndPlaces) {
  const auto refusal_of = [](const std::string& to, ImageView<const std::uint8_t> image) {
    return refusal(to, [&](const std::string& where) { write_png(where, image); });
  };
  const Image<std::uint8_t> pixel(1, 1);
  EXPECT_CONTAINS(refusal_of(path("empty.png"), {}), "is empty");
  EXPECT_CONTAINS(refusal_of(path("wide.png"), Image<std::uint8_t>(16385, 1).view()), "above 16384");
  EXPECT_CONTAINS(refusal_of(path("none/below.png"), pixel.view()), "cannot be created");
  EXPECT_CONTAINS(refusal_of(path(""), pixel.view()), "cannot be written");
  EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

}  // namespace
}  // namespace lakshya
