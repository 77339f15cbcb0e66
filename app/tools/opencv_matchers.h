// Private to the comparisons with OpenCV (disparity_estimate.h, bench_*): its matchers with our settings for them.
#pragma once

#include <opencv2/calib3d.hpp>
#include <string>

#include "app/core/image.h"

namespace lakshya {

// name: one of opencv_matcher_names().
cv::Ptr<cv::StereoMatcher> make_opencv_matcher(const std::string& name, int disparities, int min_disparity);

// The image's own memory. OpenCV has no read-only matrix: only to be read.
cv::Mat opencv_view(const Image<std::uint8_t>& image);

}  // namespace lakshya
