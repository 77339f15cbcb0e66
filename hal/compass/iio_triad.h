// A sensor of three axes in sysfs: in_magn_x_raw, in_magn_y_raw, in_magn_z_raw and what belongs to them, or in_accel_*
// (Documentation/ABI/testing/sysfs-bus-iio).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "hal/compass/matrix3.h"
#include "hal/linux/system_calls.h"
#include "hal/problem.h"
#include "kernels/base/status.h"

namespace lakshya {

// An attribute's text, in `buffer`. `error` is 0 or the system's.
std::string_view read_attribute(SystemCalls& calls, const char* folder, const char* name, std::span<char> buffer,
                                int& error);

class IioTriad {
 public:
  explicit IioTriad(SystemCalls& calls) : calls_(&calls) {}
  ~IioTriad() { close(); }
  IioTriad(const IioTriad&) = delete;
  IioTriad& operator=(const IioTriad&) = delete;

  // Whether the device in `folder` has such a channel, be it one that cannot be used.
  bool exists(const char* folder, const char* channel);

  // Of the device in `folder` the channel "magn" or "accel". Scales (in_magn_x_scale, else in_magn_scale) and the mount matrix
  // (in_magn_mount_matrix, else in_mount_matrix, else mount_matrix, else none) are read once; offsets are not used, the sensors
  // at hand have none. unsupported: it has no such channel, no scale, or a mount matrix that is no rotation; disconnected: an
  // attribute cannot be opened.
  Status open(const char* folder, const char* channel, Problem& problem);
  void close();
  bool is_open() const { return raw_[0] >= 0; }

  // `raw` are the numbers of the converter, `value` is scaled (gauss, m/s^2) and turned by the mount matrix. disconnected: the
  // device has gone (ENODEV, ENXIO, EREMOTEIO: it does not answer on its bus); bad_data: another error, or no number.
  Status read(Vector3& raw, Vector3& value, Problem& problem);

 private:
  Status open_axis(std::size_t axis, const char* folder, const char* channel, Problem& problem);
  Status read_mount(const char* folder, const char* channel, Problem& problem);

  SystemCalls* calls_;
  std::array<char, 240> place_{};  // what its attributes begin with: "/sys/bus/iio/devices/iio:device0/in_magn"
  std::array<int, 3> raw_ = {-1, -1, -1};
  Vector3 scale_{};
  Matrix3 mount_ = kIdentity3;
};

}  // namespace lakshya
