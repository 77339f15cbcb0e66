// What vehicle.yaml says of the main loop, with the default values. Keys, units, ranges and meanings: loop_config_keys.h.
#pragma once

#include <string>

namespace lakshya {

struct MemoryConfig {
  int limit_mb = 256;
};

struct MissionConfig {
  std::string way_points;
  double arrival_m = 0.5;
  double direction_deg = 0;
};

struct LoopConfig {
  int threads = 0;
  double virtual_latency_s = 0.1;
  double recovery_turn_dps = 30;
};

struct SafetyConfig {
  double camera_silent_s = 0.13;
  double compass_silent_s = 0.13;
  double perception_s = 0.13;
  double plan_age_s = 0.25;
  double control_late_s = 0.06;
  double skew_s = 0.01;
  int frozen_pairs = 2;
  double frozen_travel_m = 0.005;
  int dark_level = 8;
  double dark_share = 0.98;
  int bright_level = 250;
  double bright_share = 0.6;
  double tilt_deg = 30;
  double recover_s = 0.5;
  double degraded_speed_mps = 0.3;
  std::string recording_failed = "stop";
};

}  // namespace lakshya
