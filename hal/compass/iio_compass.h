// A magnetometer, and an accelerometer for tilt where there is one, through the kernel's industrial I/O in sysfs
// (Documentation/ABI/testing/sysfs-bus-iio).
//
// A reading becomes a heading in this order: scale (gauss, m/s^2); the kernel's mount matrix; settings.axes, after which x is
// forward, y left, z up (the kernel's matrix often means the axes of a screen: x right, y to its top, z out of it, as
// Documentation/devicetree/bindings/iio/mount-matrix.txt draws them); soft_iron * (field - hard_iron); mounting_deg; tilt;
// declination. At rest the accelerometer must show +9.81 m/s^2 on the axis that points up, as that document says. While the
// vehicle gains speed or turns, the accelerometer shows that, too: pitch, roll and, a little, yaw are then wrong.
#pragma once

#include <string>

#include "hal/clock.h"
#include "hal/compass.h"
#include "hal/compass/iio_triad.h"
#include "hal/compass/matrix3.h"
#include "hal/linux/system_calls.h"
#include "hal/retry.h"

namespace lakshya {

struct IioCompassSettings {
  std::string root = "/sys/bus/iio/devices";  // at most 128 characters
  std::string name;  // as the kernel calls the device: "hmc5883", "ak8963"; empty: the first with a magnetometer
  std::string accelerometer;       // a device's name, "none", or empty: the magnetometer's own device if it has one
  double rate_hz = 10;             // 0.1 to 100: how often read() gives a sample
  Matrix3 axes = kIdentity3;       // a rotation to x forward, y left, z up, of both sensors, row by row
  Vector3 hard_iron{};             // gauss, what the vehicle itself adds
  Matrix3 soft_iron = kIdentity3;  // what undoes the distortion, row by row; determinant above 0
  double declination_deg = 0;      // -180 to 180, true less magnetic north, east positive
  double mounting_deg = 0;         // -180 to 180, the device's forward axis from the vehicle's, left positive
  // The level part of the corrected field; outside it is no compass needle's: zero, saturated or beside a motor. The earth's is
  // 0.1 to 0.42 gauss where people live.
  double min_horizontal_gauss = 0.05;
  double max_horizontal_gauss = 0.6;
  // A number of the converter that is at least this, either sign, is saturated; 0: not known.
  int saturated_raw = 0;
};

// In the axes forward, left, up: what a calibration needs. NaN where there is no accelerometer.
struct FieldSample {
  Vector3 field_gauss{};   // without hard_iron, soft_iron and mounting_deg
  Vector3 acceleration{};  // m/s^2
  Nanoseconds time = 0;
};

class IioCompass final : public Compass {
 public:
  // `calls` and `clock` outlive the compass.
  IioCompass(IioCompassSettings settings, SystemCalls& calls, Clock& clock);
  ~IioCompass() override;
  IioCompass(const IioCompass&) = delete;
  IioCompass& operator=(const IioCompass&) = delete;

  // Looks at iio:device0 to iio:device31, and reads each sensor once.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override { return counters_; }

  // Waits until 1/rate_hz after the sample before, then measures: timeout when that is after `deadline`. bad_data at once when
  // a reading cannot be used: not a number, saturated, outside the limits above, or not between half and twice gravity. The
  // time is the middle of the magnetometer's readings. How long the kernel takes for one is its driver's matter (up to some
  // 10 ms on I2C): a call may end that much after its deadline. A device that has gone is looked for again every 200 ms, under
  // any number.
  Status read(Nanoseconds deadline, HeadingSample& sample) override;

  // The same, but only what was measured; the limits are not looked at, saturation is.
  Status read_field(Nanoseconds deadline, FieldSample& sample);

 private:
  Status check_settings();
  Status find();
  Status find_accelerometer(const char* own_folder);
  bool has_name(const char* folder, const std::string& name);
  void forget();
  bool look_again(Nanoseconds deadline);
  Status measure(FieldSample& sample);
  Status lose_or_count(Status status);
  Status refuse(const char* what, double value);

  const IioCompassSettings settings_;
  SystemCalls* calls_;
  Clock* clock_;
  IioTriad magnetometer_;
  IioTriad accelerometer_;
  bool is_open_ = false;
  Nanoseconds next_sample_ = 0;
  Retry retry_;
  Counter counters_[4] = {{"bad_readings"}, {"bad_fields"}, {"timeouts"}, {"disconnections"}};
};

}  // namespace lakshya
