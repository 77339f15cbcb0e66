// Measured or rendered disparity to compare a matcher with, and the comparison.
#pragma once

#include <cstdint>
#include <string>

#include "app/core/image.h"

namespace lakshya {

// How a file holds u_left - u_right, px of the left image.
struct GroundTruthFormat {
  enum class Kind { pfm, kitti, scaled };
  Kind kind = Kind::pfm;
  double scale = 1;  // of `scaled`: grey value per px
};

// "pfm" (infinite, NaN or negative: unknown), "kitti" (16-bit PNG, 1/256 px, 0 unknown), "scaled:S" (grey PNG of 8 or
// 16 bits, S grey levels per px, 0 unknown). Throws std::invalid_argument, which says what is wrong.
GroundTruthFormat parse_ground_truth_format(const std::string& text);

inline constexpr float kUnknownDisparity = -1;

// Disparity, or kUnknownDisparity. Throws InputError: what the image readers refuse, and a file without any known
// pixel or with disparities beyond the image's width.
Image<float> read_ground_truth(const std::string& path, const GroundTruthFormat& format);

// Makes all pixels unknown at which the mask (8-bit image of the same size, else InputError) is not 255: Middlebury's
// masks have 255 for pixels that both cameras see.
void apply_mask(const std::string& path, Image<float>& truth);

// Over the ground-truth pixels of a part of the image. Rates but `density` and `wrong_or_missing2` are over those that
// have an estimate; NaN when none has. Sources of the measures: D. Scharstein and R. Szeliski, IJCV 47, 2002 (bad);
// KITTI 2015's "D1" (error above 3 px and above 5 % of the true disparity).
struct DisparityErrors {
  std::int64_t truth_pixels = 0;
  double density = 0;
  double bad1 = 0;  // share with an error above 1 px
  double bad2 = 0;
  double bad4 = 0;
  double d1 = 0;
  double average = 0;            // mean absolute error, px
  double wrong_or_missing2 = 0;  // no estimate, or an error above 2 px
};

// estimate: 1/16 px, negative: none; same size as truth. Columns from first_column on.
DisparityErrors compare_disparity(ImageView<const std::int16_t> estimate, ImageView<const float> truth,
                                  int first_column);

}  // namespace lakshya
