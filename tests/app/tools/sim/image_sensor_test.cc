#include "app/tools/sim/image_sensor.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <vector>

#include "app/core/input_error.h"
#include "app/tools/sim/rig.h"

namespace lakshya::sim {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 150;

class ImageSensorTest : public ::testing::Test {
 protected:
  ImageSensorTest() : table_(model(), kWidth, kHeight) {
    settings_.vignetting = 0;
    settings_.focal_px = 200;
  }
  static CameraModel model() {
    SimRig rig;
    rig.width = kWidth;
    rig.height = kHeight;
    return rig_calibration(rig).left;
  }
  static Image<float> even(float radiance) { return Image<float>(kWidth, kHeight, radiance); }

  // The left eye's picture.
  Image<std::uint8_t> expose(ImageSensor& sensor, const Image<float>& radiance, const SensorFrame& frame = {}) {
    Image<std::uint8_t> left(kWidth, kHeight);
    sensor.expose(radiance.view(), radiance.view(), frame, left.view(), right_.view());
    return left;
  }
  static double mean(const Image<std::uint8_t>& image, int u0 = 0, int v0 = 0, int u1 = kWidth, int v1 = kHeight) {
    double sum = 0;
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u)
        sum += image.view().at(u, v);
    }
    return sum / ((u1 - u0) * (v1 - v0));
  }
  static double deviation(const Image<std::uint8_t>& image) {
    const double m = mean(image);
    double squares = 0;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u)
        squares += (image.view().at(u, v) - m) * (image.view().at(u, v) - m);
    }
    return std::sqrt(squares / (kWidth * kHeight));
  }

  ImageSensorSettings settings_;
  RayTable table_;
  Image<std::uint8_t> right_{kWidth, kHeight};
};

TEST_F(ImageSensorTest, ExposesTheFirstFrameRightly) {
  for (const float radiance : {0.05F, 0.5F, 3.0F}) {
    ImageSensor sensor(settings_, table_, table_);
    EXPECT_NEAR(mean(expose(sensor, even(radiance))), settings_.target_grey, 1.5) << radiance;
  }
}

TEST_F(ImageSensorTest, NoiseIsThatOfTheSettings) {
  for (const double noise : {0.0, 1.5, 4.0}) {
    settings_.noise_grey = noise;
    ImageSensor sensor(settings_, table_, table_);
    const double expected = std::sqrt(noise * noise + (noise > 0 ? 1.0 / 12 : 0));  // rounding to whole levels
    EXPECT_NEAR(deviation(expose(sensor, even(0.5F))), expected, 0.05 * expected + 0.02);
  }
}

TEST_F(ImageSensorTest, LowLightIsNoisier) {
  ImageSensor bright(settings_, table_, table_);
  ImageSensor dim(settings_, table_, table_);
  const double in_daylight = deviation(expose(bright, even(0.5F)));
  const double at_night = deviation(expose(dim, even(0.02F)));
  EXPECT_EQ(bright.gain(), 1);
  EXPECT_GT(dim.gain(), 4);
  EXPECT_GT(at_night, 2 * in_daylight);
}

TEST_F(ImageSensorTest, NoiseDependsOnFrameAndEyeNotOnThreads) {
  settings_.gain_difference = 0;
  settings_.exposure_step = 0;
  ImageSensor sensor(settings_, table_, table_);
  const auto pixels = [](const Image<std::uint8_t>& i) {
    return std::vector<std::uint8_t>(i.view().data, i.view().data + kWidth * kHeight);
  };
  SensorFrame frame;
  frame.number = 5;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto first = pixels(expose(sensor, even(0.5F), frame));
  EXPECT_NE(first, pixels(right_));
  for (const int n : {2, 3}) {
    omp_set_num_threads(n);
    EXPECT_EQ(first, pixels(expose(sensor, even(0.5F), frame)));
  }
  omp_set_num_threads(threads);
  frame.number = 6;
  EXPECT_NE(first, pixels(expose(sensor, even(0.5F), frame)));
}

TEST_F(ImageSensorTest, ExposureFollowsWithALag) {
  ImageSensor sensor(settings_, table_, table_);
  expose(sensor, even(0.5F));
  const double before = sensor.exposure();
  const double dark = mean(expose(sensor, even(0.1F)));  // the light goes off
  EXPECT_NEAR(sensor.exposure(), before, 1e-6);
  EXPECT_LT(dark, settings_.target_grey / 2);
  expose(sensor, even(0.1F));
  EXPECT_NEAR(sensor.exposure(), before * (1 + settings_.exposure_step), 1e-6);
  double last = 0;
  for (int i = 0; i < 20; ++i)
    last = mean(expose(sensor, even(0.1F)));
  EXPECT_NEAR(last, settings_.target_grey, 2);
}

TEST_F(ImageSensorTest, CornersLoseLightAndTheEyesDiffer) {
  settings_.vignetting = 0.4;
  settings_.gamma = 1;
  settings_.gain_difference = 0.1;
  ImageSensor sensor(settings_, table_, table_);
  const auto left = expose(sensor, even(0.5F));
  const double middle = mean(left, 90, 65, 110, 85);
  EXPECT_NEAR(mean(left, 0, 0, 8, 8) / middle, 0.63, 0.03);
  EXPECT_NEAR(mean(right_, 90, 65, 110, 85) / middle, 0.95 / 1.05, 0.01);
}

TEST_F(ImageSensorTest, LensAndMotionSpreadALine) {
  settings_.noise_grey = 0;
  settings_.gamma = 1;
  settings_.exposure_step = 0;
  settings_.target_grey = 20;
  Image<float> line = even(0.1F);
  for (int v = 0; v < kHeight; ++v)
    line.view().at(100, v) = 0.4F;
  ImageSensor sensor(settings_, table_, table_);
  const auto width_at = [&](double yaw_rate) {  // sum of what is above the ground over its maximum
    SensorFrame frame;
    frame.yaw_rate = yaw_rate;
    const auto picture = expose(sensor, line, frame);
    double sum = 0;
    double most = 0;
    for (int u = 80; u < 121; ++u) {
      const double above = picture.view().at(u, 70) - picture.view().at(50, 70);
      sum += above;
      most = std::max(most, above);
    }
    return sum / most;
  };
  EXPECT_NEAR(width_at(0), 1.5, 0.25);  // sqrt(2 pi) 0.6
  const double moved = 2.0 * sensor.exposure_ms() * 1e-3 * settings_.focal_px;
  EXPECT_GT(moved, 1.5);
  EXPECT_GT(width_at(2), width_at(0) + 0.3);
}

TEST_F(ImageSensorTest, LowSunVeilsThePictureAroundIt) {
  settings_.exposure_step = 0;
  ImageSensor sensor(settings_, table_, table_);
  const auto without = expose(sensor, even(0.3F));
  SensorFrame frame;
  frame.sun_left = SunInPicture{1, 0.2, -0.1};
  const auto with = expose(sensor, even(0.3F), frame);
  EXPECT_GT(mean(with), mean(without) + 3);
  EXPECT_GT(mean(with, 115, 60, 140, 75), mean(with, 0, 100, 40, 140) + 20);
}

TEST_F(ImageSensorTest, SunBehindIsNotSeen) {
  const CameraPose pose{camera_rotation(0, 0, 0), {0, 0, 1}};
  EXPECT_FALSE(sun_in_picture(pose, {-1, 0, 0.2}, 1));
  EXPECT_FALSE(sun_in_picture(pose, {1, 0, 0.2}, 0));
  const auto sun = sun_in_picture(pose, {1, 0.5, 0.2}, 1);
  ASSERT_TRUE(sun);
  EXPECT_NEAR(sun->x, -0.5, 1e-12);
  EXPECT_NEAR(sun->y, -0.2, 1e-12);
}

TEST_F(ImageSensorTest, RefusesSettingsOutsideTheirRanges) {
  settings_.largest_gain = 0.5;
  EXPECT_THROW(ImageSensor(settings_, table_, table_), InputError);
}

}  // namespace
}  // namespace lakshya::sim
