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
  std::string estop = "none";
  std::string watchdog = "none";
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

struct V4l2Config {
  std::string device = "/dev/video0";
  std::string right_device;
  std::string format = "yuyv";
  int width = 640;
  int height = 480;
  double fps = 30;
  std::string swap = "no";
  std::string check_eyes = "yes";
  double skew_ms = 5;
  int exposure_us = -1;
  int gain = -1;
  int buffers = 4;
};

struct Dc1394Config {
  std::string guid;
  int width = 640;
  int height = 480;
  std::string bayer = "none";
  std::string first_is_left = "no";
  std::string check_eyes = "yes";
  int packet_bytes = 0;
  int buffers = 4;
};

struct RecordConfig {
  std::string path;
};

struct QuicksilverConfig {
  std::string port;
  int baud = 57600;
  int stop_bits = 2;
  int left_address = 16;
  int right_address = 17;
  int left_direction = 1;
  int right_direction = 1;
  double wheel_radius_m = 0.1;
  double gear_ratio = 10;
  int counts_per_rev = 8000;
  std::string supervised = "yes";
  int velocity_register = 30;
  int counter_register = 31;
  int heartbeat_register = 32;
  int signature_register = 33;
  double watchdog_s = 0.2;
  double answer_timeout_s = 0.05;
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

struct Os5000Config {
  std::string port;
  int baud = 19200;
  std::string set_up = "yes";
  std::string command_end = "return";
  int pitch_sign = 1;
  int roll_sign = 1;
};

struct IioConfig {
  std::string name;
  std::string accelerometer;
  std::string axes = "x,y,z";
  double hard_iron_x_gauss = 0;
  double hard_iron_y_gauss = 0;
  double hard_iron_z_gauss = 0;
  double soft_iron_xx = 1;
  double soft_iron_xy = 0;
  double soft_iron_xz = 0;
  double soft_iron_yy = 1;
  double soft_iron_yz = 0;
  double soft_iron_zz = 1;
  double min_horizontal_gauss = 0.05;
  double max_horizontal_gauss = 0.6;
  int saturated_raw = 0;
};

struct OdometryConfig {
  double heading_time_s = 0.8;
  double heading_jump_deg = 20;
  double jump_hold_s = 3;
};

struct EstopConfig {
  std::string path;
  std::string chip = "gpiochip0";
  int line = -1;
  std::string active_low = "no";
};

struct WatchdogConfig {
  std::string path = "/dev/watchdog";
  int timeout_s = 10;
};

}  // namespace lakshya
