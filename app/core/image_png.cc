// PNG through libpng: https://www.w3.org/TR/png/ and libpng-manual.txt.
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "app/core/file_bytes.h"
#include "app/core/image_codecs.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxDeflateRatio = 1032;  // zlib's technical details: the most that deflate can save

struct ErrorText {
  char text[128] = "unknown error";
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* error = static_cast<ErrorText*>(png_get_error_ptr(png));
  std::snprintf(error->text, sizeof error->text, "%s", message);
  png_longjmp(png, 1);
}

// Warnings concern what is not read here: gamma, profiles, text.
void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

// Runs calls into libpng; false when libpng gave up. libpng's errors jump back to here, past every frame in
// between: `calls` must own nothing that has a destructor.
template <class Calls>
bool guarded(png_structp png, const Calls& calls) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  calls();
  return true;
}

void take_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto* rest = static_cast<Bytes*>(png_get_io_ptr(png));
  if (rest->size() < count) png_error(png, "the data end too early");
  std::memcpy(to, rest->data(), count);
  *rest = rest->subspan(count);
}

bool append(std::vector<std::uint8_t>& to, const std::uint8_t* bytes, std::size_t count) noexcept {
  try {
    to.insert(to.end(), bytes, bytes + count);
    return true;
  } catch (...) {
    return false;
  }
}

void give_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto& to = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  if (!append(to, bytes, count)) png_error(png, "out of memory");
}

class PngReader {
 public:
  PngReader(const std::string& path, Bytes bytes)
      : path_(path),
        file_size_(bytes.size()),
        rest_(bytes),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &error_, on_error, on_warning)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      refuse("libpng does not start (another version of libpng is installed?)");
    }
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[noreturn]] void refuse(const std::string& why) const { throw InputError(path_, "png: " + why); }

  void read_header() {
    run([this] {
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_image_size says it better
      png_set_read_fn(png_, &rest_, take_bytes);
      png_read_info(png_, info_);
    });
    check_image_size(path_, png_get_image_width(png_, info_), png_get_image_height(png_, info_));
    if (file_size_ < png_get_rowbytes(png_, info_) * png_get_image_height(png_, info_) / kMaxDeflateRatio) {
      refuse("is too short for its size (the file is cut off)");
    }
  }

  int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  int bit_depth() const { return png_get_bit_depth(png_, info_); }
  int color_type() const { return png_get_color_type(png_, info_); }
  int channels() const { return png_get_channels(png_, info_); }  // after expand_to_8_bits: 1 or 3

  // Palette to RGB, narrow grey to 8 bits, no alpha.
  void expand_to_8_bits() {
    run([this] {
      if (color_type() == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
      if (color_type() == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png_);
      png_set_strip_alpha(png_);
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
  }

  // 16-bit samples in the byte order of this machine.
  void keep_samples() {
    run([this] {
      if (bit_depth() == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
  }

  // All rows, and the rest of the file, so that a cut behind the pixels is noticed too.
  template <class T>
  void read_rows(T* pixels, std::size_t samples_per_row) {
    if (png_get_rowbytes(png_, info_) != samples_per_row * sizeof(T)) refuse("has an unusual layout (convert it)");
    std::vector<png_bytep> rows(static_cast<std::size_t>(height()));
    for (std::size_t v = 0; v < rows.size(); ++v) {
      rows[v] = reinterpret_cast<png_bytep>(pixels + v * samples_per_row);
    }
    run([&] {
      png_read_image(png_, rows.data());
      png_read_end(png_, nullptr);
    });
  }

 private:
  template <class Calls>
  void run(const Calls& calls) {
    if (!guarded(png_, calls)) refuse(std::string(error_.text) + " (the file is cut off or damaged)");
  }

  const std::string& path_;
  std::size_t file_size_;
  Bytes rest_;
  ErrorText error_;
  png_structp png_;
  png_infop info_;
};

Image<std::uint8_t> to_gray(const std::vector<std::uint8_t>& rgb, int width, int height) {
  Image<std::uint8_t> image(width, height);
  std::uint8_t* gray = image.view().data;
  for (std::size_t i = 0; 3 * i < rgb.size(); ++i) {
    gray[i] = luma(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
  }
  return image;
}

struct PngFormat {
  int color_type;
  int bit_depth;
};

class PngWriter {
 public:
  explicit PngWriter(const std::string& path)
      : path_(path),
        png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &error_, on_error, on_warning)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw InputError(path_, "png: libpng does not start (another version of libpng is installed?)");
    }
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  template <class T>
  std::vector<std::uint8_t> encode(ImageView<const T> image, PngFormat format) {
    std::vector<std::uint8_t> bytes;
    const bool done = guarded(png_, [&] {
      png_set_write_fn(png_, &bytes, give_bytes, nullptr);
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                   format.bit_depth, format.color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                   PNG_FILTER_TYPE_DEFAULT);
      png_write_info(png_, info_);
      if (format.bit_depth == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
      for (int v = 0; v < image.height; ++v) {
        png_write_row(png_, reinterpret_cast<png_const_bytep>(image.row(v)));
      }
      png_write_end(png_, info_);
    });
    if (!done)
      throw InputError(path_, std::string("png: cannot be encoded: ") + error_.text + " (free some memory)");
    return bytes;
  }

 private:
  const std::string& path_;
  ErrorText error_;
  png_structp png_;
  png_infop info_;
};

template <class T>
void write_png_as(const std::string& path, ImageView<const T> image, PngFormat format) {
  check_image_size(path, image.width, image.height);
  const std::vector<std::uint8_t> bytes = PngWriter(path).encode(image, format);
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

bool is_png(Bytes bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

Image<std::uint8_t> decode_png_gray(const std::string& path, Bytes bytes) {
  PngReader reader(path, bytes);
  reader.read_header();
  if (reader.bit_depth() == 16) reader.refuse("has 16-bit samples (convert it to 8 bits)");
  reader.expand_to_8_bits();
  const auto width = static_cast<std::size_t>(reader.width());
  if (reader.channels() == 1) {
    Image<std::uint8_t> image(reader.width(), reader.height());
    reader.read_rows(image.view().data, width);
    return image;
  }
  std::vector<std::uint8_t> rgb(3 * width * static_cast<std::size_t>(reader.height()));
  reader.read_rows(rgb.data(), 3 * width);
  return to_gray(rgb, reader.width(), reader.height());
}

namespace {

// Grey values that were saved as colour or as a palette.
Image<std::uint16_t> equal_channels(PngReader& reader) {
  reader.expand_to_8_bits();
  Image<std::uint16_t> image(reader.width(), reader.height());
  const auto channels = static_cast<std::size_t>(reader.channels());
  const std::size_t row = channels * static_cast<std::size_t>(reader.width());
  std::vector<std::uint8_t> samples(row * static_cast<std::size_t>(reader.height()));
  reader.read_rows(samples.data(), row);
  std::uint16_t* out = image.view().data;
  for (std::size_t i = 0; i < samples.size(); i += channels) {
    if (samples[i] != samples[i + channels - 1] || samples[i] != samples[i + channels / 2]) {
      reader.refuse("is a colour image (convert it to 16-bit grey)");
    }
    *out++ = samples[i];
  }
  return image;
}

}  // namespace

Image<std::uint16_t> decode_png_gray16(const std::string& path, Bytes bytes) {
  PngReader reader(path, bytes);
  reader.read_header();
  const bool gray = reader.color_type() == PNG_COLOR_TYPE_GRAY;
  if (gray ? reader.bit_depth() < 8 : reader.bit_depth() == 16) {
    reader.refuse("is not a grey image of 16 or 8 bits (convert it to 16-bit grey)");
  }
  if (!gray) return equal_channels(reader);
  reader.keep_samples();
  const auto width = static_cast<std::size_t>(reader.width());
  Image<std::uint16_t> image(reader.width(), reader.height());
  if (reader.bit_depth() == 16) {
    reader.read_rows(image.view().data, width);
    return image;
  }
  std::vector<std::uint8_t> narrow(width * static_cast<std::size_t>(reader.height()));
  reader.read_rows(narrow.data(), width);
  std::copy(narrow.begin(), narrow.end(), image.view().data);
  return image;
}

void write_png(const std::string& path, ImageView<const std::uint8_t> image) {
  write_png_as(path, image, {PNG_COLOR_TYPE_GRAY, 8});
}

void write_png(const std::string& path, ImageView<const std::uint16_t> image) {
  write_png_as(path, image, {PNG_COLOR_TYPE_GRAY, 16});
}

void write_png(const std::string& path, ImageView<const Rgb8> image) {
  static_assert(sizeof(Rgb8) == 3, "rows are handed to libpng as they are");
  write_png_as(path, image, {PNG_COLOR_TYPE_RGB, 8});
}

}  // namespace lakshya
