// From radiance to the 8-bit pictures of a global-shutter stereo camera: lens, exposure, noise, quantisation.
//
// Order: veil of the sun, lens blur, motion blur, vignetting, exposure, noise, gamma, 8 bits. The noise is a hash of (seed, frame,
// eye, pixel): the same for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/core/image.h"
#include "app/tools/sim/ray_table.h"
#include "kernels/base/image_view.h"

namespace lakshya::sim {

// Defaults: a small 1/3-inch global-shutter sensor with an M12 lens.
struct ImageSensorSettings {
  double lens_sigma_px = 0.6;  // of the lens's blur, 0..1.5
  double vignetting = 0.25;    // share of light lost in the corners, 0..0.9
  double gamma = 1.8;          // grey = signal^(1/gamma); 1: linear
  double target_grey = 115;    // mean that the automatic exposure wants, 1..254
  double exposure_step =
      0.15;              // the exposure changes by no more than this share in a frame; 0: it stays as it starts
  double ms_at_one = 3;  // exposure time where an irradiance of 1 on albedo 0.5 becomes middle grey (daylight)
  double shortest_ms = 0.02;      //
  double longest_ms = 12;         // in less light gain is raised instead
  double largest_gain = 16;       // >= 1; what is darker stays dark
  double noise_grey = 1.5;        // standard deviation at target_grey with gain 1, grey levels, >= 0
  double read_noise_share = 0.1;  // of its variance, 0..1; the rest is shot noise
  double gain_difference = 0.01;  // left is brighter than right by this share
  double veil = 1;                // of the sun in or near the picture: 1 a clean lens, 0 none
  double focal_px = 380;          // for motion blur
  std::uint64_t seed = 1;
};

// The sun as one eye sees it.
struct SunInPicture {
  double irradiance = 0;  // direct, at the lens; 0: in shadow
  double x = 0;           // undistorted normalised coordinates (x/z, y/z); it need not lie in the picture
  double y = 0;
};

// Nothing if the sun does not shine, or from the side or behind. `irradiance`: Renderer::sun_at() of the eye.
std::optional<SunInPicture> sun_in_picture(const CameraPose& pose, const Eigen::Vector3d& to_sun,
                                           double irradiance);

struct SensorFrame {
  std::uint64_t number = 0;  // of the frame: chooses the noise
  double yaw_rate = 0;       // rad/s of the camera, for motion blur
  std::optional<SunInPicture> sun_left, sun_right;
};

class ImageSensor {
 public:
  // Throws InputError for settings outside their ranges. The tables are the two eyes'; they outlive the sensor.
  ImageSensor(const ImageSensorSettings& settings, const RayTable& left, const RayTable& right);

  // One frame. All images have the tables' size. What is measured here sets the next frame's exposure; the first frame is
  // exposed rightly at once.
  void expose(ImageView<const float> left_radiance, ImageView<const float> right_radiance, const SensorFrame& frame,
              ImageView<std::uint8_t> left, ImageView<std::uint8_t> right);

  // Of the frame exposed last (before the first: 0).
  double exposure() const { return used_; }  // 1: daylight, see ms_at_one
  double exposure_ms() const;
  double gain() const;  // 1 or more

 private:
  void eye(ImageView<const float> radiance, const RayTable& table, const std::optional<SunInPicture>& sun,
           bool right, const SensorFrame& frame, ImageView<std::uint8_t> out);
  void add_veil(const RayTable& table, const SunInPicture& sun, ImageView<const float> in,
                ImageView<float> out) const;
  void blur(ImageView<const float> in, ImageView<float> out, double motion_px) const;
  void develop(ImageView<const float> in, float factor, std::uint32_t key, ImageView<std::uint8_t> out) const;
  double metered(ImageView<const float> left, ImageView<const float> right, double exposure) const;
  void adapt(ImageView<const float> left, ImageView<const float> right, bool at_once);

  ImageSensorSettings settings_;
  const RayTable* tables_[2];
  double exposure_ = 0;  // of the next frame; 0: not measured yet
  double used_ = 0;
  double target_signal_ = 0;
  double shot_ = 0;  // variance = gain shot signal + (gain read)^2
  double read_ = 0;
  std::vector<std::uint8_t> grey_;  // of the square root of the signal
  Image<float> veiled_;
  Image<float> blurred_;
};

}  // namespace lakshya::sim
