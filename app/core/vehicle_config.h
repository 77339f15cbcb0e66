// Everything that vehicle.yaml can say, with the default values. The list of keys with unit, range and meaning is
// in vehicle_config_keys.h; boards/host/vehicle.yaml is that list written out.
#pragma once

#include <string>

#include "app/core/device_config.h"
#include "app/core/loop_config.h"
#include "app/nav/params.h"

namespace lakshya {

// Mount of the left camera relative to the ground under the wheels and to the turning centre (body frame).
struct CameraConfig {
  double height_m = 0.60;
  double pitch_deg = 0.0;           // positive nose down
  double roll_deg = 0.0;            // positive right side down
  double yaw_deg = 0.0;             // positive to the left
  double forward_m = 0.0;           // camera in front of the turning centre
  double left_m = 0.0;              // camera to the left of the turning centre
  std::string calibration = {};     // path; empty: the recorded sequence's own
  double calibration_unit_m = 1.0;  // length of one unit of T in an OpenCV calibration file
};

struct MatcherConfig {
  std::string name = "sgm";
  int disparities = 64;
  int min_disparity = 0;
  int paths = 3;
  int p1 = 14;
  int p2 = 135;
  int p2_min = 36;
  int p2_slope = 2;
  int uniqueness_percent = 2;
  int texture_threshold = 4;
  int left_right_max_px = 1;
  int support_radius_px = 4;
  int support_min_percent = 30;
  int support_max_difference = 16;  // 1/16 px
  int bands = 4;
  int band_warmup_rows = 4;
  int window_radius_px = 5;  // sad, census
  int window_uniqueness_percent = 10;
  int window_support_min_percent = 50;
  std::string edge = "log";  // sad
  int edge_cap = 31;         // sad
};

struct PruneConfig {
  double max_depth_m = 20.0;
  double clearance_m = 1.20;
  double floor_tolerance_m = 0.04;   // tau_min
  double disparity_sigma_px = 0.25;  // sigma_d
  double pitch_sigma_deg = 0.2;      // sigma_pitch
  double sigma_factor = 3.0;         // k
  double ground_range_deg = 1.5;
  double ground_rate_deg = 0.3;
  double slope_deg = 0;
};

struct GridConfig {
  double cell_m = 0.10;
  int rows = 200;
  int cols = 200;
};

struct ScoreConfig {
  int min_count = 4;                 // n_abs
  double density = 0.15;             // rho
  double reference_height_m = 0.15;  // h_ref
  double floor_density = 0.10;       // rho_f
  double min_height_m = 0.07;        // h_min
};

struct MapConfig {
  std::string rolling = "yes";
  double size_m = 50;
  double keep_s = 20;
  double near_m = 1.5;
  int far_hits = 2;
};

struct VehicleConfig {
  std::string profile = "outdoor";
  CameraConfig camera;
  MatcherConfig matcher;
  PruneConfig prune;
  GridConfig grid;
  ScoreConfig score;
  MapConfig map;
  PlannerParams planner;
  VehicleParams vehicle;
  DriversConfig drivers;
  FolderConfig folder;
  V4l2Config v4l2;
  Dc1394Config dc1394;
  RecordConfig record;
  QuicksilverConfig quicksilver;
  PwmConfig pwm;
  CompassConfig compass;
  Os5000Config os5000;
  IioConfig iio;
  OdometryConfig odometry;
  EstopConfig estop;
  WatchdogConfig watchdog;
  MissionConfig mission;
  LoopConfig loop;
  SafetyConfig safety;
  MemoryConfig memory;
};

}  // namespace lakshya
