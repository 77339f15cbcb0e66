// A vehicle that drives by rolling map and planner among discs, without images: what the camera would show is computed from the
// discs. One step is 20 ms, a frame comes with every fifth and is obeyed 0.1 s later.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "app/core/image.h"
#include "app/nav/planner.h"
#include "app/nav/rolling_map.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"
#include "tests/support/rolling_map_arrays.h"

namespace lakshya::test {

struct Disc {
  double east_m = 0;
  double north_m = 0;
  double radius_m = 0;
};

// Discs in a field of `length` x `width` metres that begins 1 m ahead of the start: each has between 0.98 and 1.75 m to its
// nearest neighbour, and as many as go in that way.
inline std::vector<Disc> random_discs(std::mt19937& random, double length, double width) {
  std::uniform_real_distribution<double> east(1.0, 1.0 + length);
  std::uniform_real_distribution<double> north(-width / 2, width / 2);
  std::uniform_real_distribution<double> radius(0.1, 0.4);
  std::vector<Disc> discs;
  for (int i = 0; i < 4000; ++i) {
    const Disc disc{east(random), north(random), radius(random)};
    double gap = discs.empty() ? 1 : std::numeric_limits<double>::infinity();
    for (const Disc& d : discs)
      gap =
          std::min(gap, std::hypot(d.east_m - disc.east_m, d.north_m - disc.north_m) - d.radius_m - disc.radius_m);
    if (gap >= 0.98 && gap <= 1.75) discs.push_back(disc);
  }
  return discs;
}

struct DriveResult {
  bool arrived = false;
  bool collided = false;
  double time_s = 0;
  double way_m = 0;
  double least_gap_m = std::numeric_limits<double>::infinity();  // between the vehicle's circle and a disc
  Pose end;
};

class DiscDrive {
 public:
  static constexpr double kStep = 0.02;
  static constexpr int kStepsPerFrame = 5;
  static constexpr double kViewM = 6;
  static constexpr double kBlindM = 0.7;

  explicit DiscDrive(std::vector<Disc> discs) : discs_(std::move(discs)) {
    params.active_radius_m = 3;
    params.blind_zone_m = kBlindM + 0.2;
    vehicle.max_speed_mps = 1;
    vehicle.contact_time_s = 1.5;
    map_params.size_m = 16;
    map_params.blind_m = params.blind_zone_m;
    map_params.camera.angle = radians(20);
  }

  DriveResult drive(const Pose& goal, double limit_s) {
    configure();
    DriveResult result;
    Pose& pose = result.end;
    WheelSpeeds wheels;
    Plan plan;
    Pose planned_at;
    Plan next;
    Pose next_at;
    for (int i = 0; i * kStep < limit_s; ++i) {
      result.time_s = i * kStep;
      const double distance = std::hypot(goal.east_m - pose.east_m, goal.north_m - pose.north_m);
      if (distance < 0.5) {
        result.arrived = true;
        break;
      }
      if (i % kStepsPerFrame == 0) {
        plan = next;
        planned_at = next_at;
        next = look_and_plan(pose, goal, distance, i);
        next_at = pose;
      }
      wheels = steer(plan, wrap_angle(plan.direction - (pose.yaw - planned_at.yaw)), wheels);
      move(wheels, pose);
      result.way_m += std::abs(wheels.left_mps + wheels.right_mps) / 2 * kStep;
      for (const Disc& d : discs_) {
        const double gap =
            std::hypot(d.east_m - pose.east_m, d.north_m - pose.north_m) - d.radius_m - vehicle.radius_m;
        result.least_gap_m = std::min(result.least_gap_m, gap);
      }
      if (result.least_gap_m < 0) {
        result.collided = true;
        break;
      }
    }
    return result;
  }

  PlannerParams params;
  VehicleParams vehicle;
  RollingMapParams map_params;
  double view_deg = 80;
  double recovery_dps = 30;

 private:
  void configure() {
    ASSERT_EQ(map_.configure(map_params, geometry_, arrays_.make(geometry_, map_params.size_m)), Status::ok);
    ASSERT_EQ(planner_.configure(params, vehicle, geometry_, table_), Status::ok);
    prepare_view();
    state_ = {};
    has_direction_ = false;
    planned_yaw_ = 0;
  }

  Plan look_and_plan(const Pose& pose, const Pose& goal, double distance, int step) {
    look(pose);
    NavGrid frame;
    frame.geometry = geometry_;
    frame.type = type_.view();
    frame.count = count_.view();
    frame.height_sum = height_sum_.view();
    frame.floor_count = floor_count_.view();
    const MapPose at{pose, static_cast<std::int64_t>(step) * 20'000'000};
    EXPECT_EQ(map_.add(frame, at), Status::ok);
    EXPECT_EQ(map_.view(type_.view(), shown_.view()), Status::ok);
    const double turned = wrap_angle(pose.yaw - planned_yaw_);
    PlanInput input{
        .target = wrap_angle(std::atan2(goal.north_m - pose.north_m, goal.east_m - pose.east_m) - pose.yaw),
        .target_distance_m = distance,
        .heading_change = turned};
    if (has_direction_) input.previous = wrap_angle(direction_ - turned);
    Plan plan;
    EXPECT_EQ(planner_.plan(shown_.view(), input, state_, plan), Status::ok);
    planned_yaw_ = pose.yaw;
    has_direction_ = !plan.blocked;
    direction_ = plan.direction;
    return plan;
  }

  struct Ray {
    double cos = 0;
    double sin = 0;
    double reach = 0;
  };

  // Which ray meets a cell, how far away.
  struct SeenCell {
    int row = 0;
    int col = 0;
    std::size_t ray = 0;
    double distance = 0;
  };

  void prepare_view() {
    constexpr int kRays = 360;
    const double half_view = radians(view_deg / 2);
    rays_.clear();
    for (int k = 0; k <= kRays; ++k) {
      const double ray = half_view * (2.0 * k / kRays - 1);
      rays_.push_back({std::cos(ray), std::sin(ray), 0});
    }
    seen_cells_.clear();
    for (int r = 0; r < geometry_.rows; ++r) {
      for (int col = 0; col < geometry_.cols; ++col) {
        const double x = (r + 0.5) * 0.1;
        const double y = (geometry_.cols / 2.0 - col - 0.5) * 0.1;
        const double distance = std::hypot(x, y);
        const double ray = (std::atan2(y, x) / half_view + 1) / 2 * kRays;
        if (distance > kViewM || distance < kBlindM || ray < 0 || ray > kRays) continue;
        seen_cells_.push_back({r, col, static_cast<std::size_t>(ray), distance});
      }
    }
  }

  // What the camera shows: floor as far as the nearest disc, the disc's face, nothing behind it.
  void look(const Pose& pose) {
    const double c = std::cos(pose.yaw);
    const double s = std::sin(pose.yaw);
    for (int r = 0; r < geometry_.rows; ++r) {
      std::fill_n(type_.view().row(r), geometry_.cols, kCellUnknown);
      std::fill_n(count_.view().row(r), geometry_.cols, 0U);
      std::fill_n(height_sum_.view().row(r), geometry_.cols, 0);
    }
    for (Ray& ray : rays_)
      ray.reach = kViewM;
    for (const Disc& d : discs_) {
      const double x = (d.east_m - pose.east_m) * c + (d.north_m - pose.north_m) * s;
      const double y = -(d.east_m - pose.east_m) * s + (d.north_m - pose.north_m) * c;
      if (x < -1 || x * x + y * y > (kViewM + 1) * (kViewM + 1)) continue;
      for (Ray& ray : rays_) {
        const double along = x * ray.cos + y * ray.sin;
        const double beside = std::abs(x * ray.sin - y * ray.cos);
        if (along <= 0 || beside >= d.radius_m) continue;
        ray.reach = std::min(ray.reach, along - std::sqrt(d.radius_m * d.radius_m - beside * beside));
      }
    }
    for (const SeenCell& cell : seen_cells_) {
      if (cell.distance < rays_[cell.ray].reach) type_.view().at(cell.col, cell.row) = kCellUnoccupied;
    }
    for (const Ray& ray : rays_) {
      if (ray.reach >= kViewM || ray.reach < kBlindM) continue;
      const int r = static_cast<int>(std::floor(ray.reach * ray.cos * 10));
      const int col = static_cast<int>(std::floor(geometry_.cols / 2.0 - ray.reach * ray.sin * 10));
      if (r < 0 || r >= geometry_.rows || col < 0 || col >= geometry_.cols) continue;
      type_.view().at(col, r) = kCellObstacle;
      count_.view().at(col, r) = 10;
      height_sum_.view().at(col, r) = 5000;
    }
  }

  WheelSpeeds steer(const Plan& plan, double direction, const WheelSpeeds& now) const {
    double rate = turn_rate(direction, vehicle.steering_gain, radians(vehicle.max_turn_rate_dps));
    if (plan.blocked) {
      const bool stands = now.left_mps + now.right_mps == 0;
      rate = stands && !plan.hemmed_in ? radians(recovery_dps) : 0;
      if (plan.recovery == Side::right) rate = -rate;
    }
    const WheelLimits limits{vehicle.acceleration_mps2, vehicle.deceleration_mps2};
    return limit_acceleration(wheel_speeds(plan.speed_mps, rate, vehicle.track_m), now, limits, kStep);
  }

  void move(const WheelSpeeds& wheels, Pose& pose) const {
    const double turn = (wheels.right_mps - wheels.left_mps) / vehicle.track_m * kStep;
    const double way = (wheels.right_mps + wheels.left_mps) / 2 * kStep;
    pose.east_m += way * std::cos(pose.yaw + turn / 2);
    pose.north_m += way * std::sin(pose.yaw + turn / 2);
    pose.yaw = wrap_angle(pose.yaw + turn);
  }

  std::vector<Disc> discs_;
  std::vector<Ray> rays_;
  std::vector<SeenCell> seen_cells_;
  GridGeometry geometry_{.rows = 60, .cols = 80, .cell_mm = 100};
  Image<std::uint8_t> type_{80, 60, kCellUnknown};
  Image<std::uint8_t> shown_{80, 60, kCellUnknown};
  Image<std::uint32_t> count_{80, 60, 0};
  Image<std::int64_t> height_sum_{80, 60, 0};
  Image<std::uint32_t> floor_count_{80, 60, 0};
  RollingMapArrays arrays_;
  std::vector<PolarEntry> table_ = std::vector<PolarEntry>(4800);
  RollingMap map_;
  Planner planner_;
  PlanState state_;
  bool has_direction_ = false;
  double direction_ = 0;
  double planned_yaw_ = 0;
};

}  // namespace lakshya::test
