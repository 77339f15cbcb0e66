#include "app/nav/planner.h"

#include <algorithm>
#include <cmath>

#include "app/nav/sectors.h"

namespace lakshya {
namespace {

bool millimetres(double metres, std::int32_t& mm) {
  if (!(metres >= 0 && metres <= kPolarMaxActiveRadiusMm / 1000.0)) return false;
  mm = static_cast<std::int32_t>(std::lround(metres * 1000));
  return true;
}

bool finite(const PlanInput& input) {
  return std::isfinite(input.target) && std::isfinite(input.heading) && std::isfinite(input.heading_change) &&
         std::isfinite(input.previous.value_or(0));
}

GovernorParams governor_of(const VehicleParams& v) {
  return {.max_speed_mps = v.max_speed_mps,
          .latency_s = v.latency_s,
          .deceleration_mps2 = v.deceleration_mps2,
          .stop_margin_m = v.radius_m + v.stop_margin_m,
          .contact_time_s = v.contact_time_s};
}

DirectionCosts costs_of(const PlannerParams& p) {
  return {.target = p.cost_target,
          .heading = p.cost_heading,
          .previous = p.cost_previous,
          .wide_opening_sectors = p.wide_opening_sectors};
}

}  // namespace

Status Planner::configure(const PlannerParams& params, const VehicleParams& vehicle, const GridGeometry& geometry,
                          std::span<PolarEntry> table) {
  if (params.name != "vfh+" || (params.unknown != "stop" && params.unknown != "slow")) return Status::bad_argument;
  const double enlargement_m = vehicle.radius_m + vehicle.safety_distance_m;
  PolarParams polar;
  if (!millimetres(params.active_radius_m, polar.active_radius_mm) ||
      !millimetres(enlargement_m, polar.enlargement_mm))
    return Status::bad_argument;
  const Status built = build_polar_table(geometry, polar, table);
  if (built != Status::ok) return built;

  params_ = params;
  vehicle_ = vehicle;
  geometry_ = geometry;
  window_ = polar_window(geometry, polar);
  table_ = table;
  circles_ = {.radius_m = params.turning_radius_m,
              .enlargement_m = enlargement_m,
              .active_radius_m = params.active_radius_m};
  governor_ = governor_of(vehicle);
  creep_ = params.unknown == "slow";
  return Status::ok;
}

Status Planner::plan(ImageView<const std::uint8_t> type, const PlanInput& input, PlanState& state,
                     Plan& plan) const {
  if (type.height != geometry_.rows || type.width != geometry_.cols) return Status::size_mismatch;
  if (!finite(input)) return Status::bad_argument;

  Plan next;
  const Status summed = polar_histogram_ref(type, table_, next.histogram, window_);
  if (summed != Status::ok) return summed;
  turn_with_vehicle(state.binary, input.heading_change);
  state.binary.blocked =
      binary_histogram(next.histogram, state.binary.blocked, params_.threshold_low, params_.threshold_high);
  next.binary = state.binary.blocked;
  next.masked = mask_turning_circles(next.binary, type, geometry_, circles_);
  choose_sectors(type, next);
  next.openings = find_openings(next.selectable, next.masked);

  const Wishes wishes{.target = input.target, .heading = input.heading, .previous = input.previous};
  const std::optional<double> chosen = choose_direction(next.openings, next.selectable, wishes, costs_of(params_));
  if (chosen) {
    next.blocked = false;
    next.direction = *chosen;
    const ClearDistance clear =
        clear_distance(type, geometry_, next.direction, params_.blind_zone_m, vehicle_.radius_m);
    next.clear_distance_m = clear.metres;
    next.clear_end = clear.end;
    next.speed_mps = speed_towards(next.direction, speed_along(type, next));
    next.turn_rate_rps = turn_rate(next.direction, vehicle_.steering_gain, radians(vehicle_.max_turn_rate_dps));
    next.wheels = wheel_speeds(next.speed_mps, next.turn_rate_rps, vehicle_.track_m);
  } else {
    next.recovery = more_open_side(next.binary, next.seen, next.histogram);
  }
  plan = next;
  return Status::ok;
}

void Planner::choose_sectors(ImageView<const std::uint8_t> type, Plan& plan) const {
  for (std::size_t k = 0; k < kPolarSectors; ++k) {
    const RayView ray = look_along(type, geometry_, sector_centre(static_cast<int>(k)), params_.blind_zone_m);
    plan.seen[k] = ray.seen;
    plan.selectable[k] = ray.seen && ray.clear_m > 0 && !plan.masked[k];
  }
}

double Planner::speed_along(ImageView<const std::uint8_t> type, const Plan& plan) const {
  const double known = governed_speed(plan.clear_distance_m, governor_);
  if (!creep_ || plan.clear_end == ClearEnd::obstacle) return known;
  const double creep = std::min(params_.unknown_speed_mps, vehicle_.max_speed_mps);
  const double obstacle_m = corridor_obstacle_m(type, geometry_, plan.direction, vehicle_.radius_m);
  return std::min(std::max(known, creep), governed_speed(obstacle_m, governor_));
}

}  // namespace lakshya
