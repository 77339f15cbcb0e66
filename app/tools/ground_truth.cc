#include "app/tools/ground_truth.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kKittiScale = 256;
constexpr std::string_view kScaled = "scaled:";

Image<float> read_scaled(const std::string& path, double scale) {
  const Image<std::uint16_t> raw = read_gray16(path);
  Image<float> truth(raw.width(), raw.height(), kUnknownDisparity);
  for (int v = 0; v < raw.height(); ++v) {
    for (int u = 0; u < raw.width(); ++u) {
      const std::uint16_t value = raw.view().at(u, v);
      if (value != 0) truth.view().at(u, v) = static_cast<float>(value / scale);
    }
  }
  return truth;
}

Image<float> read_float(const std::string& path) {
  Image<float> truth = read_pfm(path);
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      float& d = truth.view().at(u, v);
      if (!(std::isfinite(d) && d >= 0)) d = kUnknownDisparity;
    }
  }
  return truth;
}

void require_plausible(const std::string& path, const Image<float>& truth) {
  std::int64_t known = 0;
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      const float d = truth.view().at(u, v);
      if (d < 0) continue;
      ++known;
      if (d > static_cast<float>(truth.width())) {
        throw InputError(path, "disparity: " + std::to_string(d) + " px in an image " +
                                   std::to_string(truth.width()) + " px wide (is the format or its scale right?)");
      }
    }
  }
  if (known == 0) throw InputError(path, "disparity: no pixel is known (is this the ground truth?)");
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

GroundTruthFormat parse_ground_truth_format(const std::string& text) {
  if (text == "pfm") return {GroundTruthFormat::Kind::pfm, 1};
  if (text == "kitti") return {GroundTruthFormat::Kind::kitti, kKittiScale};
  if (text.starts_with(kScaled)) {
    double scale = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + kScaled.size(), end, scale);
    if (error == std::errc{} && stop == end && scale > 0 && scale <= 65535) {
      return {GroundTruthFormat::Kind::scaled, scale};
    }
    throw std::invalid_argument("the S of scaled:S is grey levels per px, a number above 0");
  }
  throw std::invalid_argument("'" + text + "' is none of pfm, kitti, scaled:S");
}

Image<float> read_ground_truth(const std::string& path, const GroundTruthFormat& format) {
  Image<float> truth =
      format.kind == GroundTruthFormat::Kind::pfm ? read_float(path) : read_scaled(path, format.scale);
  require_plausible(path, truth);
  return truth;
}

void apply_mask(const std::string& path, Image<float>& truth) {
  const Image<std::uint8_t> mask = read_gray(path);
  if (mask.width() != truth.width() || mask.height() != truth.height()) {
    throw InputError(path, "mask size: " + size_text(mask.width(), mask.height()) +
                               " differs from the ground truth's " + size_text(truth.width(), truth.height()) +
                               " (give the mask of this image)");
  }
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u)
      if (mask.view().at(u, v) != 255) truth.view().at(u, v) = kUnknownDisparity;
  }
}

DisparityErrors compare_disparity(ImageView<const std::int16_t> estimate, ImageView<const float> truth,
                                  int first_column) {
  std::int64_t known = 0;
  std::int64_t estimated = 0;
  std::int64_t above1 = 0;
  std::int64_t above2 = 0;
  std::int64_t above4 = 0;
  std::int64_t d1 = 0;
  double sum = 0;
  for (int v = 0; v < truth.height; ++v) {
    for (int u = first_column; u < truth.width; ++u) {
      const double expected = truth.at(u, v);
      if (expected < 0) continue;
      ++known;
      if (estimate.at(u, v) < 0) continue;
      ++estimated;
      const double error = std::abs(static_cast<double>(estimate.at(u, v)) / kDisparityScale - expected);
      above1 += error > 1;
      above2 += error > 2;
      above4 += error > 4;
      d1 += error > 3 && error > 0.05 * expected;
      sum += error;
    }
  }
  const auto share = [](auto part, std::int64_t whole) {
    return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                      : static_cast<double>(part) / static_cast<double>(whole);
  };
  return {.truth_pixels = known,
          .density = share(estimated, known),
          .bad1 = share(above1, estimated),
          .bad2 = share(above2, estimated),
          .bad4 = share(above4, estimated),
          .d1 = share(d1, estimated),
          .average = share(sum, estimated),
          .wrong_or_missing2 = share(known - estimated + above2, known)};
}

}  // namespace lakshya
