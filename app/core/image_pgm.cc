// Netpbm's PGM and PPM: http://netpbm.sourceforge.net/doc/pgm.html and ppm.html.
#include <algorithm>
#include <cstddef>

#include "app/core/image_codecs.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr bool is_space(std::uint8_t c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool is_digit(std::uint8_t c) {
  return c >= '0' && c <= '9';
}

class Reader {
 public:
  Reader(const std::string& path, Bytes bytes) : path_(path), rest_(bytes) {}

  [[noreturn]] void refuse(const std::string& why) const { throw InputError(path_, "pgm/ppm: " + why); }
  Bytes rest() const { return rest_; }
  void skip(std::size_t count) { rest_ = rest_.subspan(count); }

  // A decimal number after any white space and comments; saturates, since every limit is far below.
  int number(const char* name) {
    skip_space_and_comments();
    if (rest_.empty()) refuse(std::string(name) + " is missing (the file is cut off)");
    if (!is_digit(rest_[0])) refuse(std::string(name) + " is not a number (the file is damaged)");
    int value = 0;
    while (!rest_.empty() && is_digit(rest_[0])) {
      value = std::min(value * 10 + (rest_[0] - '0'), 1'000'000);
      skip(1);
    }
    return value;
  }

  // A single white space separates maxval from binary samples, which may look like white space themselves.
  void end_of_header() {
    if (!rest_.empty() && rest_[0] == '#') skip_comment();
    if (rest_.empty()) refuse("no samples follow the header (the file is cut off)");
    if (!is_space(rest_[0])) refuse("maxval is not followed by white space (the file is damaged)");
    skip(1);
  }

 private:
  void skip_comment() {
    while (!rest_.empty() && rest_[0] != '\n' && rest_[0] != '\r') {
      skip(1);
    }
  }

  void skip_space_and_comments() {
    while (!rest_.empty() && (is_space(rest_[0]) || rest_[0] == '#')) {
      if (rest_[0] == '#') {
        skip_comment();
      } else {
        skip(1);
      }
    }
  }

  const std::string& path_;
  Bytes rest_;
};

struct Header {
  bool ascii = false;
  int channels = 1;
  int width = 0;
  int height = 0;
  int maxval = 0;
};

Header read_header(const std::string& path, Reader& reader) {
  Header header;
  const std::uint8_t kind = reader.rest()[1];
  header.ascii = kind == '2' || kind == '3';
  header.channels = kind == '3' || kind == '6' ? 3 : 1;
  reader.skip(2);
  header.width = reader.number("width");
  header.height = reader.number("height");
  check_image_size(path, header.width, header.height);
  header.maxval = reader.number("maxval");
  if (header.maxval < 1 || header.maxval > 65535) reader.refuse("maxval is not 1..65535 (the file is damaged)");
  if (header.maxval > 255) reader.refuse("has 16-bit samples (convert it to 8 bits)");
  reader.end_of_header();
  return header;
}

// One byte per binary sample; an ASCII one has a digit, and white space before all but the first.
void check_samples_fit(const Header& header, const Reader& reader) {
  const std::size_t samples = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) *
                              static_cast<std::size_t>(header.channels);
  const std::size_t needed = header.ascii ? 2 * samples - 1 : samples;
  if (reader.rest().size() >= needed) return;
  reader.refuse("has " + std::to_string(reader.rest().size()) + " bytes of samples, its header needs " +
                std::to_string(needed) + " (the file is cut off)");
}

int next_sample(const Header& header, Reader& reader) {
  int sample = 0;
  if (header.ascii) {
    sample = reader.number("sample");
  } else {
    sample = reader.rest()[0];
    reader.skip(1);
  }
  if (sample > header.maxval) reader.refuse("a sample is above maxval (the file is damaged)");
  return (sample * 255 + header.maxval / 2) / header.maxval;
}

std::uint8_t next_pixel(const Header& header, Reader& reader) {
  const int first = next_sample(header, reader);
  if (header.channels == 1) return static_cast<std::uint8_t>(first);
  const int green = next_sample(header, reader);
  const int blue = next_sample(header, reader);
  return luma(first, green, blue);
}

}  // namespace

bool is_pnm(Bytes bytes) {
  if (bytes.size() < 3 || bytes[0] != 'P' || !(is_space(bytes[2]) || bytes[2] == '#')) return false;
  return bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '5' || bytes[1] == '6';
}

Image<std::uint8_t> decode_pnm_gray(const std::string& path, Bytes bytes) {
  Reader reader(path, bytes);
  const Header header = read_header(path, reader);
  check_samples_fit(header, reader);
  Image<std::uint8_t> image(header.width, header.height);
  std::uint8_t* pixel = image.view().data;
  std::generate_n(pixel, static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height),
                  [&] { return next_pixel(header, reader); });
  return image;
}

}  // namespace lakshya
