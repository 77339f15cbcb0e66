// What vehicle.yaml says of the vehicle's devices, with the default values. Keys, units, ranges and meanings are in
// device_config_keys.h; the drivers' own settings in hal/, made of these by devices.cc.
#pragma once

#include <string>

namespace lakshya {

// Which driver does what.
struct DriversConfig {
  std::string camera = "folder";
  std::string servo = "record";
  std::string compass = "none";
  double unsupervised_speed_mps = 0.3;  // v_unsupervised
};

struct FolderConfig {
  std::string path;
  std::string left;
  std::string right;
  std::string pace = "recorded";
  double rate_hz = 10;
  std::string repeat = "no";
};

struct RecordConfig {
  std::string path;
};

struct PwmConfig {
  int chip = 0;
  int left_channel = 0;
  int right_channel = 1;
  int left_direction = 1;
  int right_direction = 1;
  int left_center_us = 1500;
  int right_center_us = 1500;
  int span_us = 500;
  int period_us = 20000;
  double full_speed_mps = 1;
  double slew_mps2 = 2;
  std::string supervised = "no";
};

// What every compass needs.
struct CompassConfig {
  double rate_hz = 10;
  double declination_deg = 0;
  double mounting_deg = 0;
};

struct OdometryConfig {
  double heading_time_s = 2;
  double heading_jump_deg = 20;
  double jump_hold_s = 3;
};

}  // namespace lakshya
