#include "app/tools/sim_peers.h"

#include "app/core/image.h"
#include "app/tools/opencv_matchers.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

cv::Mat view(ImageView<const std::uint8_t> image) {
  // OpenCV has no read-only matrix: only to be read.
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride)};
}

class OpencvMatcher final : public StandIn {
 public:
  OpencvMatcher(const std::string& name, const RectifiedGeometry& camera, const MatcherConfig& config)
      : matcher_(make_opencv_matcher(name, config.disparities, config.min_disparity)),
        least_(config.min_disparity * kDisparityScale),
        disparity_(camera.width, camera.height) {}

  Status match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
               ImageView<const std::int16_t>& disparity) override {
    matcher_->compute(view(left), view(right), found_);
    for (int v = 0; v < left.height; ++v) {
      for (int u = 0; u < left.width; ++u) {
        const auto d = found_.at<std::int16_t>(v, u);
        disparity_.view().at(u, v) = d < least_ ? std::int16_t{kNotSearched} : d;
      }
    }
    disparity = disparity_.view();
    return Status::ok;
  }

 private:
  cv::Ptr<cv::StereoMatcher> matcher_;
  const int least_;
  cv::Mat found_;
  Image<std::int16_t> disparity_;
};

}  // namespace

std::unique_ptr<StandIn> make_opencv_stand_in(sim::Sensor sensor, const RectifiedGeometry& camera,
                                              const VehicleConfig& config) {
  const std::string name(sim::kSensorNames[static_cast<std::size_t>(sensor)]);
  return std::make_unique<OpencvMatcher>(name, camera, config.matcher);
}

}  // namespace lakshya
