// Parameters of planning, speed and steering. Filled from vehicle.yaml; ranges are checked there.
#pragma once

#include <string>

namespace lakshya {

struct PlannerParams {
  std::string name = "vfh+";      // vfh+ | vfh* | vfh
  double active_radius_m = 5.0;   // r_a: obstacles farther than this do not enter the histogram
  int threshold_low = 80;         // histogram value below which a blocked sector becomes free
  int threshold_high = 120;       // ... above which a free sector becomes blocked (1000 = a cell at distance 0)
  int wide_opening_sectors = 16;  // s_max
  double cost_target = 5.0;       // mu1
  double cost_heading = 2.0;      // mu2
  double cost_previous = 2.0;     // mu3; mu1 > mu2 + mu3
  double commitment_deg =
      10.0;  // by how much nearer to the target another direction must be than the previous choice
  double turning_radius_m = 0.0;   // smallest turning circle; 0: turns in place
  double blind_zone_m = 1.5;       // unknown cells nearer than this do not stop the vehicle
  std::string unknown = "stop";    // stop | slow: what an unknown cell ahead does
  double unknown_speed_mps = 0.2;  // slow: creeping speed towards unknown cells
  double star_step_m = 0.6;        // of the look-ahead of vfh*
  int star_depth = 5;              // steps
  double route_margin_m = 0.05;   // route: least distance of the vehicle's side from the middle of an obstacle cell
  double route_comfort_m = 0.40;  // route: distance that it keeps where that is cheap
  double route_reach_m = 1.2;     // route: how far ahead it aims
  double route_first_look_deg = 50;  // route: how far it turns to either side before it sets off
  int vfh_smoothing = 5;             // l
  int vfh_threshold = 250;           // smoothed density above which a sector is no valley
  int vfh_stop_density = 10'000;     // h_m: smoothed density ahead at which the speed is 0
};

struct VehicleParams {
  double radius_m = 0.35;
  double safety_distance_m = 0.10;
  double track_m = 0.50;  // distance between the wheels
  double max_speed_mps = 7.0;
  double max_turn_rate_dps = 90.0;
  double steering_gain = 1.5;      // turn rate per direction, 1/s
  double acceleration_mps2 = 1.0;  // limit of each wheel
  double deceleration_mps2 = 2.0;  // braking that the governor counts on
  double latency_s = 0.25;         // image taken to wheels obeying
  double stop_margin_m = 0.30;     // kept between the stopped vehicle and the obstacle
  double contact_time_s = 2.8;     // the paper's 20 m at 7 m/s
};

}  // namespace lakshya
