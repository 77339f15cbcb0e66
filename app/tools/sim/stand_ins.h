// Perfect sensors in the place of the stereo matcher, under the same map and planner.
#pragma once

#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/tools/sim/camera_pose.h"
#include "app/tools/sim/renderer.h"

namespace lakshya::sim {

// Where the vehicle was when the pair that is being processed was taken.
struct Shot {
  VehicleState vehicle;
  CameraPose rectified;
  double time_s = 0;
  WalkTimes walks;
};

// The rays of a rectified left camera.
RayTable rectified_rays(const RectifiedGeometry& camera);

// The true disparity of every pixel, glass included: the upper bound of what a stereo camera could see.
class TrueDepth final : public StandIn {
 public:
  // All outlive it. disparities: the search range's end, px.
  TrueDepth(Renderer& renderer, const RectifiedGeometry& camera, double max_disparity_px, const Shot& shot);

  Status match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
               ImageView<const std::int16_t>& disparity) override;

 private:
  Renderer* renderer_;
  const RectifiedGeometry camera_;
  const double max_disparity_px_;
  const Shot* shot_;
  RayTable rays_;
  Image<float> depth_;
  Image<std::int16_t> thing_;
  Image<std::int16_t> disparity_;
};

// A laser scanner without error that looks 135 degrees to either side, level with the vehicle's ground, 0.3 m above it: table tops
// and hanging bars are not there for it, nor are holes, kerbs or glass.
class LevelLaser final : public StandIn {
 public:
  LevelLaser(Renderer& renderer, int width, int height, const Shot& shot);

  Status match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
               ImageView<const std::int16_t>& disparity) override;
  Status see(const NavGrid& grid) override;

 private:
  void scan(double bearing, const NavGrid& grid) const;

  Renderer* renderer_;
  const Shot* shot_;
  Image<std::int16_t> nothing_;
};

}  // namespace lakshya::sim
