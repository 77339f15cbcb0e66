// The one list of what vehicle.yaml may say: loading, --set, range checks, boards/host/vehicle.yaml and the table
// in docs/configuration.md all derive from it. A new field of VehicleConfig gets one line here and nothing
// elsewhere. The symbols in the meanings (tau_min, k, rho, mu1, ...) are those of docs/contract.md sections 1 to 5.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "app/core/config_key.h"
#include "app/core/device_config_keys.h"
#include "app/core/loop_config_keys.h"
#include "app/core/vehicle_config.h"
#include "app/nav/vfh.h"
#include "app/nav/vfh_star.h"

namespace lakshya {

inline constexpr std::array<std::string_view, 3> kMatcherNames{"sgm", "census", "sad"};
inline constexpr std::array<std::string_view, 2> kEdgeNames{"log", "sobel"};
inline constexpr std::array<std::string_view, 4> kPlannerNames{"vfh+", "vfh*", "route", "vfh"};
inline constexpr std::array<std::string_view, 2> kUnknownNames{"stop", "slow"};

struct Group {
  std::string_view name;
  std::string_view meaning;
};
inline constexpr std::array<Group, 25> kGroups{{
    {"camera", "Mount of the left camera, relative to the ground under the wheels and to the turning centre"},
    {"matcher", "From the rectified pair to disparities"},
    {"prune", "Which points matter: depth, floor and ceiling"},
    {"grid",
     "The navigation map: its first row begins at the turning centre, half of its columns lie to each side"},
    {"score", "What makes a cell of the map an obstacle or unoccupied"},
    {"map", "The rolling map, which remembers what was seen"},
    {"planner", "From the map to a direction"},
    {"vehicle", "The vehicle's body, speed and steering"},
    {"drivers", "Which devices the vehicle has"},
    {"folder", "Camera driver folder"},
    {"v4l2", "Camera driver v4l2: one stereo camera of the kernel's with both eyes side by side, or two cameras"},
    {"dc1394", "Camera driver dc1394: PGR Bumblebee2 or XB3 on IEEE 1394"},
    {"record", "Servo driver record"},
    {"quicksilver", "Servo driver quicksilver: two QuickSilver drives on one serial line"},
    {"pwm", "Servo driver pwm: two hobby drives on a PWM chip of the kernel's"},
    {"compass", "What every compass needs"},
    {"os5000", "Compass driver os5000: OceanServer OS5000"},
    {"iio", "Compass driver iio: a magnetometer of the kernel's industrial I/O"},
    {"odometry", "The pose from the wheels' travel and the compass"},
    {"estop", "Emergency stop drivers file and gpio"},
    {"watchdog", "Watchdog driver linux"},
    {"mission", "Where to go"},
    {"loop", "The main loop"},
    {"safety", "When the main loop stops the wheels (docs/safety.md)"},
    {"memory", "The main loop's memory"},
}};

// A profile is a list of overrides, as text: what --set would say.
struct Override {
  std::string_view key;
  std::string_view value;
};
struct Profile {
  std::string_view name;
  std::string_view meaning;
  std::span<const Override> overrides;
};
inline constexpr std::array<Override, 3> kOutdoorOverrides{{
    {"prune.max_depth_m", "20.0"},
    {"planner.active_radius_m", "8.0"},
    {"vehicle.max_speed_mps", "7.0"},
}};
inline constexpr std::array<Override, 4> kIndoorOverrides{{
    {"prune.max_depth_m", "8.0"},
    {"planner.active_radius_m", "3.0"},
    {"vehicle.max_speed_mps", "1.0"},
    {"vehicle.contact_time_s", "1.5"},
}};
inline constexpr std::array<Profile, 2> kProfiles{{
    {"outdoor", "The paper's setting: open ground, 20 m of depth at up to 7 m/s", kOutdoorOverrides},
    {"indoor",
     "Rooms and corridors: walking pace, near obstacles only, so that a doorway is not closed by what lies behind "
     "it",
     kIndoorOverrides},
}};

// The visitor is called with (const Key&, field, allowed values): Range for double and int fields, Names for
// std::string fields with a choice, Text for others. Keys of one group follow each other, groups in the order of kGroups.
template <class Camera, class Visitor>
void visit_camera_keys(Camera& c, Visitor& v) {
  v(Key{"camera.height_m", "m", "Height of the left camera's centre above the ground (H)"}, c.height_m,
    Range{0.05, 5});
  v(Key{"camera.pitch_deg", "deg", "Tilt of the optical axis, positive nose down"}, c.pitch_deg, Range{-45, 60});
  v(Key{"camera.roll_deg", "deg", "Tilt about the optical axis, positive right side down"}, c.roll_deg,
    Range{-30, 30});
  v(Key{"camera.yaw_deg", "deg", "Direction of the optical axis from straight ahead, positive to the left"},
    c.yaw_deg, Range{-90, 90});
  v(Key{"camera.forward_m", "m", "How far the left camera is in front of the turning centre"}, c.forward_m,
    Range{-5, 5});
  v(Key{"camera.left_m", "m", "How far the left camera is to the left of the turning centre"}, c.left_m,
    Range{-5, 5});
  v(Key{"camera.calibration", "",
        "Calibration: one file, left and right file with a comma between, or a folder, seen from vehicle.yaml's "
        "folder; "
        "empty: the recorded sequence's own"},
    c.calibration, Text{});
  v(Key{"camera.calibration_unit_m", "m",
        "Length of one unit of T in an OpenCV calibration file (0.001: millimetres)"},
    c.calibration_unit_m, Range{0.0001, 10});
}

template <class Matcher, class Visitor>
void visit_matcher_keys(Matcher& c, Visitor& v) {
  v(Key{"matcher.name", "",
        "Matching method (sgm: census cost, semi-global aggregation; census, sad: square window of census codes, "
        "or of "
        "edges as in the paper)"},
    c.name, Names{kMatcherNames});
  v(Key{"matcher.disparities", "px", "Number of disparities searched; more of them see nearer"}, c.disparities,
    Range{16, 512, 16});
  v(Key{"matcher.min_disparity", "px", "Smallest disparity searched, doffs included"}, c.min_disparity,
    Range{0, 1024});
  v(Key{"matcher.paths", "", "sgm: aggregation paths, 5, or 3 without the two diagonals"}, c.paths, Range{3, 5, 2});
  v(Key{"matcher.p1", "", "sgm: penalty for a disparity step of 1 px along a path (P1), at most p2_min"}, c.p1,
    Range{0, 182});
  v(Key{"matcher.p2", "", "sgm: penalty for a larger disparity step (P2) where the image is even"}, c.p2,
    Range{0, 182});
  v(Key{"matcher.p2_min", "", "sgm: least P2, across an edge of the image; at most p2"}, c.p2_min, Range{0, 182});
  v(Key{"matcher.p2_slope", "per grey level", "sgm: by how much P2 falls per grey level between the two pixels"},
    c.p2_slope, Range{0, 255});
  v(Key{"matcher.uniqueness_percent", "%",
        "sgm: margin by which the best cost must beat every other that is not its neighbour"},
    c.uniqueness_percent, Range{0, 50});
  v(Key{"matcher.texture_threshold", "grey levels",
        "Sum of grey-level differences along the row in the 9 x 7 window below which a pixel is not matched"},
    c.texture_threshold, Range{0, 16065});
  v(Key{"matcher.left_right_max_px", "px", "Largest difference between the left and the right image's match"},
    c.left_right_max_px, Range{0, 16});
  v(Key{"matcher.support_radius_px", "px",
        "Half width of the window in which neighbours must agree; 0: no such test"},
    c.support_radius_px, Range{0, 15});
  v(Key{"matcher.support_min_percent", "%",
        "sgm: share of that window's pixels that must agree with its centre, itself included"},
    c.support_min_percent, Range{0, 100});
  v(Key{"matcher.support_max_difference", "sixteenths of a px",
        "Largest difference of disparity that still agrees"},
    c.support_max_difference, Range{0, 256});
  v(Key{"matcher.bands", "",
        "Horizontal bands of the image, matched independently; part of the result, not of the machine"},
    c.bands, Range{1, 64});
  v(Key{"matcher.band_warmup_rows", "rows", "sgm: rows above a band that are aggregated first"}, c.band_warmup_rows,
    Range{0, 256});
  v(Key{"matcher.window_radius_px", "px", "census, sad: half width of the square window that is compared"},
    c.window_radius_px, Range{0, 15});
  v(Key{"matcher.window_uniqueness_percent", "%", "census, sad: uniqueness_percent of these matchers"},
    c.window_uniqueness_percent, Range{0, 50});
  v(Key{"matcher.window_support_min_percent", "%", "census, sad: support_min_percent of these matchers"},
    c.window_support_min_percent, Range{0, 100});
  v(Key{"matcher.edge", "",
        "sad: edge filter before the comparison (log: Laplacian of Gaussian; sobel: along the row)"},
    c.edge, Names{kEdgeNames});
  v(Key{"matcher.edge_cap", "", "sad: edges stronger than this count as this strong"}, c.edge_cap, Range{1, 34});
}

template <class Prune, class Visitor>
void visit_prune_keys(Prune& c, Visitor& v) {
  v(Key{"prune.max_depth_m", "m", "Points farther from the camera than this are dropped (z_max)"}, c.max_depth_m,
    Range{0.5, 100});
  v(Key{"prune.clearance_m", "m",
        "Points higher than this above the ground are dropped: the vehicle passes below (C)"},
    c.clearance_m, Range{0.1, 10});
  v(Key{"prune.floor_tolerance_m", "m",
        "Points within this height above or below the ground are floor (tau_min); less than camera.height_m"},
    c.floor_tolerance_m, Range{0, 1});
  v(Key{"prune.disparity_sigma_px", "px", "Standard deviation of a disparity (sigma_d)"}, c.disparity_sigma_px,
    Range{0.01, 8});
  v(Key{"prune.pitch_sigma_deg", "deg", "Standard deviation of the pitch (sigma_pitch)"}, c.pitch_sigma_deg,
    Range{0, 10});
  v(Key{"prune.sigma_factor", "", "Standard deviations by which a point must leave the floor (k)"}, c.sigma_factor,
    Range{0, 10});
  v(Key{"prune.ground_range_deg", "deg",
        "How far the floor seen in the image may correct the mount's pitch, either way; 0: the mount's plane as it "
        "is"},
    c.ground_range_deg, Range{0, 5});
  v(Key{"prune.ground_rate_deg", "deg", "By how much that correction may change from one frame to the next"},
    c.ground_rate_deg, Range{0, 5});
  v(Key{"prune.slope_deg", "deg",
        "The steepest ramp, up or down, that is driven (10 is good): ground that rises or falls less is floor; 0: "
        "ramps are gone "
        "round, since the sides of one may be driven over (docs/driving.md)"},
    c.slope_deg, Range{0, 20});
}

template <class Grid, class Visitor>
void visit_grid_keys(Grid& c, Visitor& v) {
  v(Key{"grid.cell_m", "m", "Side of a square cell, in whole millimetres"}, c.cell_m, Range{0.02, 1, 0.001});
  v(Key{"grid.rows", "cells", "Cells ahead"}, c.rows, Range{10, 1000});
  v(Key{"grid.cols", "cells", "Cells across, an even number"}, c.cols, Range{10, 1000, 2});
}

template <class Score, class Visitor>
void visit_score_keys(Score& c, Visitor& v) {
  v(Key{"score.min_count", "points",
        "Least number of obstacle points that decide about a cell, at any distance (n_abs)"},
    c.min_count, Range{1, 10000});
  v(Key{"score.density", "",
        "Share of the pixels of a face, one cell wide and reference_height_m high, that must be points (rho)"},
    c.density, Range{0, 1});
  v(Key{"score.reference_height_m", "m", "Height of that face (h_ref)"}, c.reference_height_m, Range{0.01, 2});
  v(Key{"score.floor_density", "",
        "Share of a cell's pixels that must be floor, or below it, to decide that it is unoccupied, or a drop-off "
        "(rho_f)"},
    c.floor_density, Range{0, 1});
  v(Key{"score.min_height_m", "m", "Mean height of a cell's points above which it is an obstacle (h_min)"},
    c.min_height_m, Range{0, 2});
}

template <class Map, class Visitor>
void visit_map_keys(Map& c, Visitor& v) {
  v(Key{"map.rolling", "",
        "What was seen is carried along by odometry and heading; no: every frame is planned with alone"},
    c.rolling, Names{kNoYes});
  v(Key{"map.size_m", "m", "Side of the square about the vehicle within which things are remembered"}, c.size_m,
    Range{5, 200});
  v(Key{"map.keep_s", "s", "What was not seen for so long is forgotten"}, c.keep_s, Range{0, 3600});
  v(Key{"map.near_m", "m",
        "An obstacle nearer than this and the braking distance is believed when one frame shows it"},
    c.near_m, Range{0, 100});
  v(Key{"map.far_hits", "frames", "Farther away, at most so many frames must show it"}, c.far_hits, Range{1, 12});
}

template <class Planner, class Visitor>
void visit_planner_keys(Planner& c, Visitor& v) {
  v(Key{"planner.name", "",
        "Planning method (route: the cheapest way through the rolling map; vfh+: Ulrich and Borenstein 1998; vfh*: "
        "2000, which looks ahead; vfh: Borenstein and Koren 1991, without the vehicle's size)"},
    c.name, Names{kPlannerNames});
  v(Key{"planner.active_radius_m", "m", "Obstacles farther from the turning centre than this are ignored (r_a)"},
    c.active_radius_m, Range{0.5, 100});
  v(Key{"planner.threshold_low", "", "Histogram value below which a blocked sector becomes free"}, c.threshold_low,
    Range{1, 100000});
  v(Key{"planner.threshold_high", "",
        "Histogram value above which a free sector becomes blocked; one obstacle cell at distance 0 gives 1000"},
    c.threshold_high, Range{1, 100000});
  v(Key{"planner.wide_opening_sectors", "sectors",
        "Openings wider than this many sectors of 5 deg are wide (s_max)"},
    c.wide_opening_sectors, Range{1, 72});
  v(Key{"planner.cost_target", "",
        "Cost of leaving the target's direction (mu1), more than the other two together"},
    c.cost_target, Range{0, 100});
  v(Key{"planner.cost_heading", "", "Cost of leaving the present heading (mu2)"}, c.cost_heading, Range{0, 100});
  v(Key{"planner.cost_previous", "", "Cost of leaving the previous choice (mu3)"}, c.cost_previous, Range{0, 100});
  v(Key{"planner.commitment_deg", "deg",
        "vfh+, vfh*: by how much nearer to the target another direction must be than the previous choice"},
    c.commitment_deg, Range{0, 90});
  v(Key{"planner.turning_radius_m", "m", "Radius of the smallest turning circle; 0: the vehicle turns in place"},
    c.turning_radius_m, Range{0, 20});
  v(Key{"planner.blind_zone_m", "m",
        "Unknown cells nearer than this, before the first known one, do not stop the vehicle"},
    c.blind_zone_m, Range{0, 10});
  v(Key{"planner.unknown", "",
        "What an unknown cell ahead does: stop before it, or slow down to unknown_speed_mps"},
    c.unknown, Names{kUnknownNames});
  v(Key{"planner.unknown_speed_mps", "m/s", "Creeping speed towards unknown cells, used by unknown: slow"},
    c.unknown_speed_mps, Range{0, 5});
  v(Key{"planner.star_step_m", "m", "vfh*: length of one step of the look-ahead"}, c.star_step_m, Range{0.1, 10});
  v(Key{"planner.star_depth", "steps", "vfh*: how many steps it looks ahead"}, c.star_depth,
    Range{1, kStarMaxDepth});
  v(Key{"planner.route_margin_m", "m",
        "route: least distance between the vehicle's side and the middle of an obstacle cell"},
    c.route_margin_m, Range{0, 2});
  v(Key{"planner.route_comfort_m", "m", "route: distance from the vehicle's side that is kept where that is cheap"},
    c.route_comfort_m, Range{0, 5});
  v(Key{"planner.route_reach_m", "m", "route: how far ahead the vehicle aims"}, c.route_reach_m, Range{0.2, 20});
  v(Key{"planner.route_first_look_deg", "deg",
        "route: how far the vehicle turns to either side before it sets off, to see what stands beside it; 0: not "
        "at all"},
    c.route_first_look_deg, Range{0, 90});
  v(Key{"planner.vfh_smoothing", "sectors",
        "vfh: neighbours to either side that a sector's density is smoothed with (l); 0: none"},
    c.vfh_smoothing, Range{0, kMaxSmoothing});
  v(Key{"planner.vfh_threshold", "",
        "vfh: smoothed density above which a sector is blocked; one obstacle cell at distance 0 gives 545 with l = "
        "5"},
    c.vfh_threshold, Range{1, 100000});
  v(Key{"planner.vfh_stop_density", "",
        "vfh: smoothed density straight ahead at which the speed becomes 0 (h_m), in proportion below it"},
    c.vfh_stop_density, Range{1, 1000000});
}

template <class Vehicle, class Visitor>
void visit_vehicle_keys(Vehicle& c, Visitor& v) {
  v(Key{"vehicle.radius_m", "m", "Radius of the circle about the turning centre that holds the vehicle (r_robot)"},
    c.radius_m, Range{0.05, 5});
  v(Key{"vehicle.safety_distance_m", "m", "Distance kept from obstacles beside the vehicle (d_safe)"},
    c.safety_distance_m, Range{0, 2});
  v(Key{"vehicle.track_m", "m", "Distance between the left and the right wheels"}, c.track_m, Range{0.05, 5});
  v(Key{"vehicle.max_speed_mps", "m/s", "Greatest speed (v_max)"}, c.max_speed_mps, Range{0.05, 20});
  v(Key{"vehicle.max_turn_rate_dps", "deg/s", "Greatest turn rate"}, c.max_turn_rate_dps, Range{1, 360});
  v(Key{"vehicle.steering_gain", "per s",
        "Turn rate per angle between heading and chosen direction (k of steering)"},
    c.steering_gain, Range{0.05, 10});
  v(Key{"vehicle.acceleration_mps2", "m/s^2", "Limit of each wheel while it gets faster"}, c.acceleration_mps2,
    Range{0.05, 20});
  v(Key{"vehicle.deceleration_mps2", "m/s^2",
        "Limit of each wheel while it gets slower: the braking that the speed governor counts on (a)"},
    c.deceleration_mps2, Range{0.05, 20});
  v(Key{"vehicle.latency_s", "s", "Time from the image taken to the wheels obeying (t_latency)"}, c.latency_s,
    Range{0, 5});
  v(Key{"vehicle.stop_margin_m", "m", "Distance kept between the stopped vehicle and the obstacle ahead"},
    c.stop_margin_m, Range{0, 10});
  v(Key{"vehicle.contact_time_s", "s",
        "Least time to reach the end of the clear distance at the chosen speed (t_contact); 0: no such limit"},
    c.contact_time_s, Range{0, 60});
}

// Config: VehicleConfig or const VehicleConfig. `profile` is no key: it selects which overrides apply.
template <class Config, class Visitor>
void visit_keys(Config& c, Visitor&& v) {
  visit_camera_keys(c.camera, v);
  visit_matcher_keys(c.matcher, v);
  visit_prune_keys(c.prune, v);
  visit_grid_keys(c.grid, v);
  visit_score_keys(c.score, v);
  visit_map_keys(c.map, v);
  visit_planner_keys(c.planner, v);
  visit_vehicle_keys(c.vehicle, v);
  visit_device_keys(c, v);
  visit_main_loop_keys(c, v);
}

}  // namespace lakshya
