// Portable float map: P. Debevec, "PFM Portable FloatMap Image Format", and Middlebury's use of it for disparity.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "app/core/image_codecs.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxToken = 32;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(path, "pfm: " + why);
}

bool is_space(std::uint8_t c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// The next word of the header and the one white space behind it: more may belong to the samples.
std::string_view take_word(const std::string& path, Bytes& rest, const char* name) {
  while (!rest.empty() && is_space(rest[0])) {
    rest = rest.subspan(1);
  }
  const auto end = std::find_if(rest.begin(), rest.end(), is_space);
  if (end == rest.end()) refuse(path, std::string(name) + " is missing (the file is cut off)");
  const auto length = static_cast<std::size_t>(end - rest.begin());
  if (length > kMaxToken) refuse(path, std::string(name) + " is not a number (the file is damaged)");
  const std::string_view word(reinterpret_cast<const char*>(rest.data()), length);
  rest = rest.subspan(length + 1);
  return word;
}

template <class T>
T take_number(const std::string& path, Bytes& rest, const char* name) {
  const std::string_view word = take_word(path, rest, name);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    refuse(path, std::string(name) + " '" + std::string(word) + "' is not a number (the file is damaged)");
  }
  return value;
}

float sample_at(const std::uint8_t* bytes, bool little_endian) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
    bits |= std::uint32_t{bytes[i]} << 8 * (little_endian ? i : 3 - i);
  return std::bit_cast<float>(bits);
}

}  // namespace

bool is_pfm(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == 'f' || bytes[1] == 'F') && is_space(bytes[2]);
}

Image<float> decode_pfm(const std::string& path, Bytes bytes) {
  if (!is_pfm(bytes)) refuse(path, "does not start with Pf (give a PFM file of one channel)");
  if (bytes[1] == 'F') refuse(path, "has three channels (give the one-channel disparity, Pf)");
  Bytes rest = bytes.subspan(2);
  const auto width = take_number<std::int64_t>(path, rest, "width");
  const auto height = take_number<std::int64_t>(path, rest, "height");
  check_image_size(path, width, height);
  const auto scale = take_number<double>(path, rest, "scale");
  if (!std::isfinite(scale) || scale == 0) refuse(path, "scale is 0 or not finite (its sign is the byte order)");
  const std::size_t needed = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (rest.size() != needed) {
    refuse(path, "has " + std::to_string(rest.size()) + " bytes of samples, its header says " +
                     std::to_string(needed) + " (the file is cut off or damaged)");
  }
  Image<float> image(static_cast<int>(width), static_cast<int>(height));
  const std::uint8_t* sample = rest.data();
  for (int v = image.height() - 1; v >= 0; --v) {
    for (int u = 0; u < image.width(); ++u, sample += 4)
      image.view().at(u, v) = sample_at(sample, scale < 0);
  }
  return image;
}

}  // namespace lakshya
