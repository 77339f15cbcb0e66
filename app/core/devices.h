// The registry of drivers: which names there are, and the driver of that name made of what the configuration says. A new
// driver is one line in devices.cc, one name in device_config_keys.h, and its group of keys.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "app/core/vehicle_config.h"
#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/compass.h"
#include "hal/compass/iio_compass.h"
#include "hal/estop.h"
#include "hal/odometry/wheel_odometry.h"
#include "hal/servo.h"
#include "hal/watchdog.h"

namespace lakshya {

// A driver that is made but not open yet.
template <class Kind>
struct Made {
  std::shared_ptr<void> below;   // what it talks through: a serial port, a folder
  std::unique_ptr<Kind> device;  // null for the driver "none"; goes before what it talks through
};

template <class Kind>
struct Driver {
  std::string_view name;
  Made<Kind> (*make)(const VehicleConfig& config, Clock& clock);
};

std::span<const Driver<StereoCamera>> camera_drivers();
std::span<const Driver<Servo>> servo_drivers();
std::span<const Driver<Compass>> compass_drivers();
std::span<const Driver<EmergencyStop>> estop_drivers();
std::span<const Driver<Watchdog>> watchdog_drivers();

// Those that the configuration names. `clock` outlives them. Throws InputError where the configuration lacks what the
// driver needs (a port, images, a line), and for "sim", which only a simulator has.
Made<StereoCamera> make_camera(const VehicleConfig& config, Clock& clock);
Made<Servo> make_servo(const VehicleConfig& config, Clock& clock);
Made<Compass> make_compass(const VehicleConfig& config, Clock& clock);
Made<EmergencyStop> make_estop(const VehicleConfig& config, Clock& clock);
Made<Watchdog> make_watchdog(const VehicleConfig& config, Clock& clock);

// Throws InputError for iio.axes that are none. For a calibration, which wants the field itself.
IioCompassSettings iio_settings(const VehicleConfig& config);

WheelOdometrySettings odometry_settings(const VehicleConfig& config);

}  // namespace lakshya
