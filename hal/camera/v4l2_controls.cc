#include "hal/camera/v4l2_controls.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace lakshya {
namespace {

constexpr int kExposureUnitUs = 100;     // V4L2_CID_EXPOSURE_ABSOLUTE
constexpr double kRateTolerance = 0.01;  // 29.97 is 30

// 0, with the value that the driver made of it, or -errno.
int set_control(SystemCalls& calls, int fd, std::uint32_t id, int& value) {
  v4l2_ext_control control{};
  control.id = id;
  control.value = value;
  v4l2_ext_controls request{};
  request.which = V4L2_CTRL_WHICH_CUR_VAL;
  request.count = 1;
  request.controls = &control;
  int error = calls.ioctl(fd, VIDIOC_S_EXT_CTRLS, &request);
  if (error >= 0) value = control.value;
  if (error != -ENOTTY) return std::min(error, 0);
  v4l2_control old{};  // a driver from before there were extended ones
  old.id = id;
  old.value = value;
  error = calls.ioctl(fd, VIDIOC_S_CTRL, &old);
  if (error >= 0) value = old.value;
  return std::min(error, 0);
}

// -1 where there is none. Drivers of either kind understand this.
int control_of(SystemCalls& calls, int fd, std::uint32_t id) {
  v4l2_control control{};
  control.id = id;
  return calls.ioctl(fd, VIDIOC_G_CTRL, &control) >= 0 ? control.value : -1;
}

bool takes(SystemCalls& calls, int fd, std::uint32_t id, int value) {
  int taken = value;
  return set_control(calls, fd, id, taken) == 0 && taken == value;
}

class Setter {
 public:
  Setter(SystemCalls& calls, int fd, const char* place, Problem& problem)
      : calls_(&calls), fd_(fd), place_(place), problem_(&problem) {}

  void rate(double wanted, double& given);
  void exposure(int us);
  void gain(int gain);
  int not_taken() const { return not_taken_; }

 private:
  void must(const char* what, std::uint32_t id, int value);

  SystemCalls* calls_;
  int fd_;
  const char* place_;
  Problem* problem_;
  int not_taken_ = 0;
};

void Setter::must(const char* what, std::uint32_t id, int value) {
  int taken = value;
  const int error = set_control(*calls_, fd_, id, taken);
  if (error == 0 && taken == value) return;
  ++not_taken_;
  if (error == 0) {
    problem_->set("%s: %s became %d instead of %d", place_, what, taken, value);
  } else {
    problem_->set("%s: %s cannot be set to %d: %s", place_, what, value, strerrordesc_np(-error));
  }
}

void Setter::rate(double wanted, double& given) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_captureparm& capture = parameters.parm.capture;
  given = 0;
  int error = calls_->ioctl(fd_, VIDIOC_G_PARM, &parameters);
  if (error >= 0 && wanted > 0) {
    constexpr double kDenominator = 1000;
    capture.timeperframe.numerator = static_cast<std::uint32_t>(kDenominator);
    capture.timeperframe.denominator = static_cast<std::uint32_t>(std::lround(wanted * kDenominator));
    error = calls_->ioctl(fd_, VIDIOC_S_PARM, &parameters);
  }
  const v4l2_fract interval = capture.timeperframe;
  if (error >= 0 && interval.numerator > 0) given = static_cast<double>(interval.denominator) / interval.numerator;
  if (wanted <= 0 || std::abs(given - wanted) <= wanted * kRateTolerance) return;
  ++not_taken_;
  if (error < 0) {
    problem_->set("%s: the frame rate cannot be set to %g: %s", place_, wanted, strerrordesc_np(-error));
  } else {
    problem_->set("%s: %g frames a second instead of %g", place_, given, wanted);
  }
}

// Webcams call their automatic exposure aperture priority, others have a fully automatic one; a camera without any has nothing
// to be switched.
void Setter::exposure(int us) {
  if (us < 0) {
    if (!takes(*calls_, fd_, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY)) {
      (void)takes(*calls_, fd_, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_AUTO);
    }
    return;
  }
  (void)takes(*calls_, fd_, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL);
  must("exposure in 100 us", V4L2_CID_EXPOSURE_ABSOLUTE, std::max(1, (us + kExposureUnitUs / 2) / kExposureUnitUs));
}

void Setter::gain(int gain) {
  (void)takes(*calls_, fd_, V4L2_CID_AUTOGAIN, gain < 0 ? 1 : 0);
  if (gain >= 0) must("gain", V4L2_CID_GAIN, gain);
}

}  // namespace

int set_controls(SystemCalls& calls, int fd, const char* place, const V4l2Controls& wanted, double& fps,
                 Problem& problem) {
  Setter setter(calls, fd, place, problem);
  setter.rate(wanted.fps, fps);
  setter.exposure(wanted.exposure_us);
  setter.gain(wanted.gain);
  return setter.not_taken();
}

V4l2Light read_light(SystemCalls& calls, int fd) {
  const int mode = control_of(calls, fd, V4L2_CID_EXPOSURE_AUTO);
  return {.automatic_exposure = mode >= 0 && mode != V4L2_EXPOSURE_MANUAL,
          .exposure = control_of(calls, fd, V4L2_CID_EXPOSURE_ABSOLUTE),
          .automatic_gain = control_of(calls, fd, V4L2_CID_AUTOGAIN) > 0,
          .gain = control_of(calls, fd, V4L2_CID_GAIN)};
}

int compare_lights(const V4l2Light& first, const char* first_place, const V4l2Light& second,
                   const char* second_place, Problem& problem) {
  const struct {
    const char* name;
    bool automatic;
    int first;
    int second;
  } kinds[] = {
      {"exposure", first.automatic_exposure || second.automatic_exposure, first.exposure, second.exposure},
      {"gain", first.automatic_gain || second.automatic_gain, first.gain, second.gain},
  };
  int unequal = 0;
  for (const auto& kind : kinds) {
    const bool differs = kind.first >= 0 && kind.second >= 0 && kind.first != kind.second;
    if (!kind.automatic && !differs) continue;
    ++unequal;
    if (kind.automatic) {
      problem.set("%s, %s: automatic %s is each camera's own; two want a fixed one", first_place, second_place,
                  kind.name);
    } else {
      problem.set("%s, %s: %s is %d and %d", first_place, second_place, kind.name, kind.first, kind.second);
    }
  }
  return unequal;
}

}  // namespace lakshya
