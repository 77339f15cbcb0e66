// Disparity of a rectified pair by one of our matchers, or by OpenCV's for comparison.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/core/image.h"
#include "app/core/kernel_table.h"
#include "app/core/vehicle_config.h"

namespace lakshya {

struct DisparityEstimate {
  Image<std::int16_t> disparity;  // u_left - u_right in 1/16 px; negative: none
  double ms = 0;                  // of the matching alone
};

// With config.name. Images of one size. Throws InputError when the search range lies outside.
DisparityEstimate match_pair(const MatcherConfig& config, const KernelTable& kernels,
                             const Image<std::uint8_t>& left, const Image<std::uint8_t>& right);

// What decides about a matcher's result, for reports: "census 9x7 ..., p1 8, ...".
std::string parameters_text(const MatcherConfig& config);

// opencv-bm, opencv-sgbm, opencv-sgbm-3way.
std::span<const char* const> opencv_matcher_names();

// OpenCV's matcher `name` with the settings that OpenCV's samples and users have found to work well, the same for all
// images (see parameters_text below). disparities: a multiple of 16.
DisparityEstimate match_pair_opencv(const std::string& name, int disparities, int min_disparity,
                                    const Image<std::uint8_t>& left, const Image<std::uint8_t>& right);
std::string opencv_parameters_text(const std::string& name);

}  // namespace lakshya
