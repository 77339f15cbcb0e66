#include "app/nav/planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/nav/sectors.h"

namespace lakshya {
namespace {

// How far a vehicle that nothing is open to looks, in enlargements: what lies behind the next gap is not decided yet.
constexpr double kNarrowReach = 3;
// A turn goes on for about as many frames after a plan has ended it.
constexpr double kCarriedTurn = 2.5;
// On a route: the least way ahead of the body that is crept on, and the direction from which on the vehicle turns in place.
constexpr double kCreepClear = 0.10;
constexpr double kTurnsInPlace = radians(60);

bool millimetres(double metres, std::int32_t& mm) {
  if (!(metres >= 0 && metres <= kPolarMaxActiveRadiusMm / 1000.0)) return false;
  mm = static_cast<std::int32_t>(std::lround(metres * 1000));
  return true;
}

bool finite(const PlanInput& input) {
  return std::isfinite(input.target) && std::isfinite(input.heading) && std::isfinite(input.heading_change) &&
         std::isfinite(input.previous.value_or(0)) && input.target_distance_m >= 0;
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
          .wide_opening_sectors = p.wide_opening_sectors,
          .commitment = radians(p.commitment_deg)};
}

bool is_vfh(const PlannerParams& p) {
  return p.name == "vfh";
}

bool is_star(const PlannerParams& p) {
  return p.name == "vfh*";
}

bool is_route(const PlannerParams& p) {
  return p.name == "route";
}

bool usable(const PlannerParams& p) {
  return p.commitment_deg >= 0 && p.star_step_m > 0 && std::isfinite(p.star_step_m) && p.star_depth >= 1 &&
         p.star_depth <= kStarMaxDepth && (p.name == "vfh+" || is_star(p) || is_vfh(p) || is_route(p)) &&
         (p.unknown == "stop" || p.unknown == "slow") && p.vfh_smoothing >= 0 && p.vfh_smoothing <= kMaxSmoothing &&
         p.vfh_stop_density > 0;
}

// An arc that leaves straight ahead and ends in the aimed point turns by twice its direction: faster than this the vehicle would pass
// beside it.
double speed_on_arc(double turn_rate_rps, const RouteAim& route) {
  const double bend = 2 * std::abs(std::sin(route.direction));
  constexpr double kStraight = 1e-6;
  return bend < kStraight ? std::numeric_limits<double>::infinity()
                          : std::abs(turn_rate_rps) * route.straight_m / bend;
}

}  // namespace

Thresholds histogram_thresholds(const PlannerParams& params) {
  if (is_vfh(params)) return {params.vfh_threshold, params.vfh_threshold};
  return {params.threshold_low, params.threshold_high};
}

Status Planner::configure(const PlannerParams& params, const VehicleParams& vehicle, const GridGeometry& geometry,
                          std::span<PolarEntry> table, decltype(&polar_histogram_ref) sum) {
  if (!usable(params)) return Status::bad_argument;
  const double enlargement_m = vehicle.radius_m + vehicle.safety_distance_m;
  PolarParams polar;
  if (!millimetres(params.active_radius_m, polar.active_radius_mm) ||
      !millimetres(enlargement_m, polar.enlargement_mm))
    return Status::bad_argument;
  if (is_vfh(params)) {
    polar.enlargement_mm = 0;
    polar.weight = PolarWeight::linear;
  }
  const Status built = build_polar_table(geometry, polar, table);
  if (built != Status::ok) return built;

  params_ = params;
  vehicle_ = vehicle;
  geometry_ = geometry;
  window_ = polar_window(geometry, polar);
  table_ = table;
  sum_histogram_ = sum;
  circles_ = {.radius_m = params.turning_radius_m,
              .enlargement_m = enlargement_m,
              .active_radius_m = params.active_radius_m};
  // A cell may be occupied up to its corner.
  corridor_m_ = vehicle.radius_m + geometry.cell_mm / 1000.0 * std::numbers::sqrt2 / 2;
  governor_ = governor_of(vehicle);
  creep_ = params.unknown == "slow";
  is_vfh_ = is_vfh(params);
  is_star_ = is_star(params);
  is_route_ = is_route(params);
  return Status::ok;
}

Status Planner::plan(ImageView<const std::uint8_t> type, const PlanInput& input, PlanState& state,
                     Plan& plan) const {
  if (type.height != geometry_.rows || type.width != geometry_.cols) return Status::size_mismatch;
  if (!finite(input)) return Status::bad_argument;

  Plan next;
  const Status summed = sum_histogram_(type, table_, next.histogram, window_);
  if (summed != Status::ok) return summed;
  block_sectors(input.heading_change, state, next);
  next.masked = mask_turning_circles(next.binary, type, geometry_, circles_);
  choose_sectors(type, next);
  next.openings = find_openings(next.selectable, next.masked);

  if (is_route_ && input.route) {
    follow_route(*input.route, next);
    recover(input.heading_change, state, next);
    plan = next;
    return Status::ok;
  }
  std::optional<double> chosen = choose(type, input, next);
  if (!chosen && !is_vfh_ && state.recovery.active) chosen = squeeze(type, input, next);
  if (chosen) {
    next.blocked = false;
    next.direction = *chosen;
    be_patient(input, state, next);
    const ClearDistance clear = clear_distance(type, geometry_, next.direction, params_.blind_zone_m, corridor_m_);
    next.clear_distance_m = clear.metres;
    next.clear_end = clear.end;
    double speed_mps = std::min(speed_along(type, next), speed_limit(input, next));
    if (next.waits) speed_mps = 0;
    if (next.squeezes) speed_mps = std::min(speed_mps, params_.unknown_speed_mps);
    next.speed_mps = speed_towards(
        next.direction, std::min(speed_mps, speed_while_turning(type, next.direction, input.heading_change)));
    next.turn_rate_rps = turn_rate(next.direction, vehicle_.steering_gain, radians(vehicle_.max_turn_rate_dps));
    next.wheels = wheel_speeds(next.speed_mps, next.turn_rate_rps, vehicle_.track_m);
  }
  recover(input.heading_change, state, next);
  plan = next;
  return Status::ok;
}

// A way may lead through gaps that are too narrow for the governor's margin: these are taken slowly.
void Planner::follow_route(const RouteAim& route, Plan& plan) const {
  if (!route.found) return;
  plan.blocked = false;
  plan.direction = route.direction;
  plan.clear_distance_m = route.clear_m;
  plan.clear_end = route.clear_end;
  const double creep = std::min(params_.unknown_speed_mps, vehicle_.max_speed_mps);
  const auto allowed = [&](double clear_m) {
    const double governed = governed_speed(clear_m, governor_);
    return clear_m > vehicle_.radius_m + kCreepClear ? std::max(governed, creep) : governed;
  };
  const double speed_mps = std::min(allowed(route.clear_m), allowed(route.swept_m));
  plan.turn_rate_rps = turn_rate(plan.direction, vehicle_.steering_gain, radians(vehicle_.max_turn_rate_dps));
  const double turning = std::max(0.0, 1 - std::abs(plan.direction) / kTurnsInPlace);
  plan.speed_mps = std::min(speed_mps * turning, speed_on_arc(plan.turn_rate_rps, route));
  plan.wheels = wheel_speeds(plan.speed_mps, plan.turn_rate_rps, vehicle_.track_m);
}

void Planner::block_sectors(double heading_change, PlanState& state, Plan& plan) const {
  const Thresholds thresholds = histogram_thresholds(params_);
  if (is_vfh_) {
    plan.histogram = smoothed_histogram(plan.histogram, params_.vfh_smoothing);
    plan.binary = binary_histogram(plan.histogram, {}, thresholds.low, thresholds.high);
    return;
  }
  turn_with_vehicle(state.binary, heading_change);
  state.binary.blocked = binary_histogram(plan.histogram, state.binary.blocked, thresholds.low, thresholds.high);
  plan.binary = state.binary.blocked;
}

std::optional<double> Planner::squeeze(ImageView<const std::uint8_t> type, const PlanInput& input,
                                       Plan& plan) const {
  const double reach_m =
      std::min(params_.active_radius_m, kNarrowReach * (vehicle_.radius_m + vehicle_.safety_distance_m));
  StarCells cells;
  find_star_cells(type, geometry_, reach_m, cells);
  if (cells.count == 0) return std::nullopt;
  const PolarHistogram histogram = star_histogram(cells, geometry_, reach_m, corridor_m_);
  const SectorMask blocked = binary_histogram(histogram, {}, params_.threshold_high, params_.threshold_high);
  Plan narrow = plan;
  narrow.masked = mask_turning_circles(blocked, type, geometry_, circles_);
  choose_sectors(type, narrow);
  narrow.openings = find_openings(narrow.selectable, narrow.masked);
  const Wishes wishes{.target = input.target, .heading = input.heading, .previous = input.previous};
  const std::optional<double> chosen =
      choose_direction(narrow.openings, narrow.selectable, wishes, costs_of(params_));
  if (!chosen) return std::nullopt;
  plan = narrow;
  plan.squeezes = true;
  return chosen;
}

void Planner::be_patient(const PlanInput& input, PlanState& state, Plan& plan) const {
  const bool other_way = !is_vfh_ && input.previous && angle_between(plan.direction, *input.previous) > kOtherWay;
  state.disagreements = other_way ? state.disagreements + 1 : 0;
  if (!other_way) return;
  if (state.disagreements > kPatience) {
    state.disagreements = 0;
    return;
  }
  plan.waits = true;
  plan.direction = *input.previous;
}

void Planner::recover(double heading_change, PlanState& state, Plan& plan) const {
  Recovery& recovery = state.recovery;
  if (!plan.blocked) {
    if (recovery.active && ++recovery.open_for > Recovery::kRemembered) recovery = {};
    return;
  }
  if (!recovery.active) {
    recovery = {.active = true, .side = more_open_side(plan.binary, plan.seen, plan.histogram)};
  } else if (recovery.open_for == 0) {
    recovery.turned += std::abs(heading_change);
  }
  recovery.open_for = 0;
  plan.recovery = recovery.side;
  plan.hemmed_in = recovery.turned > 2 * std::numbers::pi;
}

std::optional<double> Planner::choose(ImageView<const std::uint8_t> type, const PlanInput& input,
                                      const Plan& plan) const {
  if (is_vfh_) return choose_in_valley(plan.openings, plan.selectable, input.target, params_.wide_opening_sectors);
  const Wishes wishes{.target = input.target, .heading = input.heading, .previous = input.previous};
  if (!is_star_) return choose_direction(plan.openings, plan.selectable, wishes, costs_of(params_));
  const StarParams star{.step_m = params_.star_step_m,
                        .depth = params_.star_depth,
                        .clearance_m = vehicle_.radius_m + vehicle_.safety_distance_m / 2,
                        .active_radius_m = params_.active_radius_m,
                        .threshold = params_.threshold_high};
  return choose_by_look_ahead({type, geometry_, table_}, plan.openings, plan.selectable, wishes,
                              input.target_distance_m, costs_of(params_), star);
}

// A vehicle that is still turning towards its direction sweeps what lies between, and goes on for a while with the turn that it is
// in: it goes no faster than straight ahead, half way and there allow. One that cannot turn on the spot has its turning circles
// masked, and would get stuck by this.
double Planner::speed_while_turning(ImageView<const std::uint8_t> type, double direction,
                                    double heading_change) const {
  if (params_.turning_radius_m > 0) return vehicle_.max_speed_mps;
  double least = vehicle_.max_speed_mps;
  const double carried = std::clamp(kCarriedTurn * heading_change, -radians(90), radians(90));
  for (const double swept : {0.0, direction / 2, carried}) {
    const double obstacle_m = corridor_obstacle_m(type, geometry_, swept, corridor_m_);
    least = std::min(least, governed_speed(obstacle_m, governor_));
  }
  return least;
}

double Planner::speed_limit(const PlanInput& input, const Plan& plan) const {
  if (!is_vfh_) return vehicle_.max_speed_mps;
  const std::uint32_t ahead = plan.histogram[sector_index(sector_of(input.heading))];
  return density_speed(ahead, params_.vfh_stop_density, vehicle_.max_speed_mps);
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
  const double obstacle_m = corridor_obstacle_m(type, geometry_, plan.direction, corridor_m_);
  return std::min(std::max(known, creep), governed_speed(obstacle_m, governor_));
}

}  // namespace lakshya
