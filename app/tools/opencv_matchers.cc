#include "app/tools/opencv_matchers.h"

#include <stdexcept>

#include "app/tools/disparity_estimate.h"
#include "hal/clock/monotonic_clock.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr int kBlockSizeBm = 15;
constexpr int kBlockSizeSgbm = 5;
constexpr int kP1 = 8 * kBlockSizeSgbm * kBlockSizeSgbm;
constexpr int kP2 = 32 * kBlockSizeSgbm * kBlockSizeSgbm;
constexpr int kUniqueness = 10;
constexpr int kLeftRight = 1;
constexpr int kPreFilterCap = 63;
constexpr int kSpeckleWindow = 100;
constexpr int kSpeckleRange = 2;

constexpr const char* kNames[] = {"opencv-bm", "opencv-sgbm", "opencv-sgbm-3way"};

}  // namespace

cv::Ptr<cv::StereoMatcher> make_opencv_matcher(const std::string& name, int disparities, int min_disparity) {
  if (name == kNames[0]) {
    const cv::Ptr<cv::StereoBM> bm = cv::StereoBM::create(disparities, kBlockSizeBm);
    bm->setMinDisparity(min_disparity);
    bm->setUniquenessRatio(kUniqueness);
    bm->setDisp12MaxDiff(kLeftRight);
    bm->setSpeckleWindowSize(kSpeckleWindow);
    bm->setSpeckleRange(kSpeckleRange);
    return bm;
  }
  if (name != kNames[1] && name != kNames[2]) throw std::invalid_argument("no OpenCV matcher is called " + name);
  const int mode = name == kNames[1] ? cv::StereoSGBM::MODE_SGBM : cv::StereoSGBM::MODE_SGBM_3WAY;
  return cv::StereoSGBM::create(min_disparity, disparities, kBlockSizeSgbm, kP1, kP2, kLeftRight, kPreFilterCap,
                                kUniqueness, kSpeckleWindow, kSpeckleRange, mode);
}

cv::Mat opencv_view(const Image<std::uint8_t>& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.view().data)};
}

std::span<const char* const> opencv_matcher_names() {
  return kNames;
}

DisparityEstimate match_pair_opencv(const std::string& name, int disparities, int min_disparity,
                                    const Image<std::uint8_t>& left, const Image<std::uint8_t>& right) {
  const cv::Ptr<cv::StereoMatcher> matcher = make_opencv_matcher(name, disparities, min_disparity);
  cv::Mat found;
  const MonotonicClock clock;
  const Nanoseconds start = clock.now();
  matcher->compute(opencv_view(left), opencv_view(right), found);
  const Nanoseconds took = clock.now() - start;
  DisparityEstimate estimate{Image<std::int16_t>(left.width(), left.height()), static_cast<double>(took) * 1e-6};
  static_assert(kDisparityScale == cv::StereoMatcher::DISP_SCALE);
  for (int v = 0; v < left.height(); ++v) {
    for (int u = 0; u < left.width(); ++u) {
      const auto d = found.at<std::int16_t>(v, u);  // (min_disparity - 1) * 16: none
      estimate.disparity.view().at(u, v) = d < min_disparity * kDisparityScale ? std::int16_t{kNotSearched} : d;
    }
  }
  return estimate;
}

std::string opencv_parameters_text(const std::string& name) {
  const std::string common = "uniquenessRatio " + std::to_string(kUniqueness) + ", disp12MaxDiff " +
                             std::to_string(kLeftRight) + ", speckle " + std::to_string(kSpeckleWindow) + "/" +
                             std::to_string(kSpeckleRange);
  const std::string version = "OpenCV " CV_VERSION " ";
  if (name == kNames[0]) return version + "StereoBM, block " + std::to_string(kBlockSizeBm) + ", " + common;
  return version + "StereoSGBM " + (name == kNames[1] ? "MODE_SGBM" : "MODE_SGBM_3WAY") + ", block " +
         std::to_string(kBlockSizeSgbm) + ", P1 " + std::to_string(kP1) + ", P2 " + std::to_string(kP2) +
         ", preFilterCap " + std::to_string(kPreFilterCap) + ", " + common;
}

}  // namespace lakshya
