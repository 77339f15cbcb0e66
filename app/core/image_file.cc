#include "app/core/image_file.h"

#include <cstddef>
#include <vector>

#include "app/core/file_bytes.h"
#include "app/core/image_codecs.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

// The largest PFM within the limits, with room for a header.
constexpr std::size_t kMaxFileBytes = static_cast<std::size_t>(4 * kMaxImagePixels) + (1U << 20);

}  // namespace

void check_image_size(const std::string& path, std::int64_t width, std::int64_t height) {
  const auto size = [&] { return "image size: " + std::to_string(width) + " x " + std::to_string(height); };
  if (width < 1 || height < 1) throw InputError(path, size() + " is empty (give an image that has pixels)");
  if (width > kMaxImageSide || height > kMaxImageSide) {
    throw InputError(path, size() + " has a side above " + std::to_string(kMaxImageSide) + " (scale it down)");
  }
  if (width * height > kMaxImagePixels) {
    throw InputError(path,
                     size() + " has more than " + std::to_string(kMaxImagePixels) + " pixels (scale it down)");
  }
}

Image<std::uint8_t> read_gray(const std::string& path) {
  return decode_gray(path, read_file(path, kMaxFileBytes));
}

Image<std::uint8_t> decode_gray(const std::string& path, std::span<const std::uint8_t> bytes) {
  if (is_png(bytes)) return decode_png_gray(path, bytes);
  if (is_pnm(bytes)) return decode_pnm_gray(path, bytes);
  if (is_jpeg(bytes)) return decode_jpeg_gray(path, bytes);
  throw InputError(path, "image format: not a PNG, PGM, PPM or JPEG image (convert it to one of these)");
}

Image<std::uint16_t> read_gray16(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path, kMaxFileBytes);
  if (is_png(bytes)) return decode_png_gray16(path, bytes);
  throw InputError(path, "image format: not a PNG image (convert it to a grey PNG)");
}

Image<float> read_pfm(const std::string& path) {
  return decode_pfm(path, read_file(path, kMaxFileBytes));
}

}  // namespace lakshya
