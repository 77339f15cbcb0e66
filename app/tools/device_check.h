// Tries one device for a while and says what came of it: `lakshya devices --test`.
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>

#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/compass.h"
#include "hal/servo.h"

namespace lakshya {

struct DeviceCheck {
  std::string fault;  // empty: the device did what it should
  nlohmann::ordered_json facts =
      nlohmann::ordered_json::object();  // what was seen, by name; at the end the driver's counters
};

struct CheckSettings {
  double seconds = 3;
  double speed_mps = 0;  // servo: 0 turns no wheel
  const std::atomic<bool>* interrupt =
      nullptr;  // when it becomes true, the device is closed and the check ends, at fault
};

// Opens the device, uses it, closes it.
//
// Camera: pairs for `seconds`; at fault when none comes, or none any more, when the pair's eyes are all black or saturated, and when its images
// never change although the camera does not say that it is static.
DeviceCheck check_camera(StereoCamera& camera, Clock& clock, const CheckSettings& settings);

// Servo: without a speed the way is watched for `seconds`, for whoever pushes the vehicle; with one each wheel alone and both turn
// forward and back for `seconds` / 6 each, longer where speeding up takes long, and come to rest. The way since the start is told. At
// fault when a command fails, and when a measured way is off by more than a fifth or has the wrong sign.
DeviceCheck check_servo(Servo& servo, Clock& clock, const CheckSettings& settings);

// Compass: readings for `seconds`; at fault when none comes, or none any more.
DeviceCheck check_compass(Compass& compass, Clock& clock, const CheckSettings& settings);

// A line per fact.
std::string device_check_text(const DeviceCheck& check);

}  // namespace lakshya
