#include "app/tools/sim/run_world.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/core/geometry.h"
#include "app/loop/memory_watch.h"
#include "app/loop/stepped_run.h"
#include "app/tools/sim/free_space.h"
#include "app/tools/sim/truth.h"
#include "app/tools/sim/walk.h"
#include "hal/angle.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya::sim {
namespace {

constexpr double kTraceStep = 0.1;     // s
constexpr double kLookStep = 0.1;      // s, between two looks at who is in view
constexpr double kFarthestPerson = 8;  // m, that counts as in view
constexpr double kStands = 0.02;       // m/s
constexpr double kTurnSeconds = static_cast<double>(kControlPeriod) / static_cast<double>(kSecond);

// Whom the camera has seen, and for how long of the last seconds.
class PeopleInView {
 public:
  PeopleInView(const World& world, double memory_s) : world_(&world), seen_(world.things.size()) {
    for (std::vector<bool>& looks : seen_)
      looks.assign(static_cast<std::size_t>(std::llround(memory_s / kLookStep)), false);
  }

  void look(Simulation& simulation, const RectifiedGeometry& camera, const WalkTimes& when) {
    const CameraPose& eye = simulation.shot().rectified;
    ++looks_;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const Thing& thing = world_->things[i];
      if (!thing.walk) continue;
      const Place place = place_on_walk(*thing.walk, when.of(i));
      seen_[i][looks_ % seen_[i].size()] = sees(simulation.renderer(), camera, eye, {place.x, place.y, 0.9});
    }
  }
  double seconds(int thing) const {
    const auto& looks = seen_[static_cast<std::size_t>(thing)];
    return static_cast<double>(std::ranges::count(looks, true)) * kLookStep;
  }

 private:
  static bool sees(Renderer& renderer, const RectifiedGeometry& camera, const CameraPose& eye,
                   const Eigen::Vector3d& point) {
    const Eigen::Vector3d way = point - eye.position;
    const Eigen::Vector3d in_camera = eye.world_from_camera.transpose() * way;
    if (in_camera.z() < 0.1 || way.norm() > kFarthestPerson) return false;
    const double u = camera.cx_left + camera.focal_px * in_camera.x() / in_camera.z();
    if (u < 0 || u >= camera.width) return false;
    constexpr double kBodyRadius = 0.4;
    return renderer.range(eye.position, way.normalized(), false) > way.norm() - kBodyRadius;
  }

  const World* world_;
  std::vector<std::vector<bool>> seen_;
  std::size_t looks_ = 0;
};

class Drive final : public FrameSink {
 public:
  Drive(const World& world, const VehicleConfig& config, const RunRules& rules, Simulation& simulation,
        Machinery& machinery, Clock& clock, Onlooker* onlooker)
      : world_(&world),
        config_(&config),
        rules_(rules),
        simulation_(&simulation),
        m_(&machinery),
        clock_(&clock),
        onlooker_(onlooker),
        truth_(world),
        people_(world, rules.person_memory_s) {
    result_.min_clearance_m = std::numeric_limits<double>::infinity();
    m_->perception().show(this);
  }
  ~Drive() override { m_->perception().show(nullptr); }
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  void on_frame(const FrameResult& frame, const PlanNote& plan) override {
    const MemoryWatch not_the_loops(WatchedPlace::nowhere);
    took_.push_back(plan.took);
    blocked_ = plan.blocked;
    if (onlooker_ != nullptr) onlooker_->on_frame(frame, plan, simulation_->shot());
  }

  void after_turn() {
    const double time_s = simulation_->seconds(clock_->now());
    const VehicleState& vehicle = simulation_->vehicle().at(clock_->now());
    walks_ = simulation_->walks(clock_->now());
    listen(vehicle);
    if (over_) return;
    if (time_s >= next_trace_) {
      result_.trace.push_back({time_s, vehicle.x, vehicle.y, vehicle.yaw, vehicle.speed_mps, blocked_});
      next_trace_ += kTraceStep;
      people_.look(*simulation_, simulation_->camera(), walks_);
    }
    touch(vehicle);
    watch_progress(vehicle, time_s);
    watch_standing(vehicle);
    if (!over_ && arrived_) {
      const double allowed_m = rules_.goal_tolerance_m + rules_.goal_drift * vehicle.path_m;
      end(goal_distance(vehicle) <= allowed_m ? Ending::reached : Ending::stuck);
    }
    if (!over_ && time_s >= world_->time_limit_s) end(Ending::timeout);
    if (over_) finish(vehicle, time_s);
  }

  RunResult result() && {
    std::ranges::sort(took_);
    if (!took_.empty()) {
      result_.frame_ms_p50 = static_cast<double>(took_[took_.size() / 2]) * 1e-6;
      result_.frame_ms_p99 = static_cast<double>(took_[took_.size() * 99 / 100]) * 1e-6;
    }
    return std::move(result_);
  }

 private:
  void listen(const VehicleState& vehicle) {
    Exchange& x = m_->exchange();
    StateNote note;
    while (x.notes.pop(note)) {
      if (onlooker_ != nullptr) onlooker_->on_state(note);
    }
    Decision decision;
    while (x.decisions.pop(decision)) {
    }
    if (!x.status.take()) return;
    arrived_ = x.status.reading().way_point >= world_->goals.size();
    if (onlooker_ != nullptr) onlooker_->on_turn(x.status.reading(), vehicle);
  }

  void touch(const VehicleState& v) {
    const Nearest nearest =
        truth_.nearest(v.x, v.y, v.z + rules_.body_bottom_m, v.z + config_->prune.clearance_m, walks_, true);
    const double radius = config_->vehicle.radius_m;
    const double clearance = nearest.distance_m - radius;
    const bool stands = std::abs(v.speed_mps) < kStands && std::abs(v.turn_rate_rps) < kStands;
    const bool is_walker = nearest.thing >= 0 && world_->things[static_cast<std::size_t>(nearest.thing)].walk;
    if (clearance < 0 && is_walker && stands) {
      if (!bumped_) ++result_.bumps;
      bumped_ = true;
      return;
    }
    if (clearance >= 0) bumped_ = false;
    if (bumped_) return;  // he still stands where he walked into us
    result_.min_clearance_m = std::min(result_.min_clearance_m, std::max(0.0, clearance));
    if (clearance < 0) hit(nearest);
    const double reach = 0.8 * radius;
    for (int i = 0; i < 8 && !over_; ++i) {
      const double angle = v.yaw + i * std::numbers::pi / 4;
      if (truth_.dropoff_at(v.x + reach * std::cos(angle), v.y + reach * std::sin(angle))) end(Ending::dropoff);
    }
  }

  void hit(const Nearest& nearest) {
    end(Ending::collision);
    if (nearest.thing < 0) {
      result_.hit = result_.hit_kind =
          nearest.patch >= 0 ? world_->ground.patches[static_cast<std::size_t>(nearest.patch)].kind : "ground";
      return;
    }
    const Thing& thing = world_->things[static_cast<std::size_t>(nearest.thing)];
    result_.hit = thing.name;
    result_.hit_kind = thing.kind;
    if (thing.expect == Expect::glass) result_.excuse = "glass";
    if (thing.walk && people_.seconds(nearest.thing) < rules_.person_seen_s) result_.excuse = "person not in view";
  }

  void watch_progress(const VehicleState& v, double time_s) {
    if (std::hypot(v.x - progress_x_, v.y - progress_y_) >= rules_.stuck_way_m || progress_time_ < 0) {
      progress_x_ = v.x;
      progress_y_ = v.y;
      progress_time_ = time_s;
    } else if (!over_ && time_s - progress_time_ > rules_.stuck_s) {
      end(Ending::stuck);
    }
  }

  void watch_standing(const VehicleState& v) {
    const bool stands = std::abs(v.speed_mps) < kStands && std::abs(v.turn_rate_rps) < kStands;
    const bool has_driven = v.path_m > 0.2;
    if (!stands || !has_driven || arrived_) {
      stood_s_ = 0;
      return;
    }
    stood_s_ += kTurnSeconds;
    if (stood_s_ < rules_.false_stop_s || stood_s_ - kTurnSeconds >= rules_.false_stop_s) return;
    if (is_free_ahead(v)) ++result_.false_stops;
  }

  bool is_free_ahead(const VehicleState& v) const {
    constexpr double kStep = 0.05;
    for (double way = 0; way <= rules_.false_stop_clear_m; way += kStep) {
      const double x = v.x + way * std::cos(v.yaw);
      const double y = v.y + way * std::sin(v.yaw);
      const double z = ground_height(world_->ground, x, y);
      if (truth_.dropoff_at(x, y)) return false;
      const Nearest nearest =
          truth_.nearest(x, y, z + rules_.body_bottom_m, z + config_->prune.clearance_m, walks_, true);
      if (nearest.distance_m < config_->vehicle.radius_m) return false;
    }
    return true;
  }

  double goal_distance(const VehicleState& v) const {
    return std::hypot(v.x - world_->goals.back().x(), v.y - world_->goals.back().y());
  }

  void end(Ending ending) {
    if (over_) return;
    over_ = true;
    result_.ending = ending;
    m_->exchange().terminate.store(true);
  }

  void finish(const VehicleState& v, double time_s) {
    result_.time_s = time_s;
    result_.path_m = v.path_m;
    result_.mean_speed_mps = time_s > 0 ? v.path_m / time_s : 0;
    result_.frames = m_->perception().frames();
    result_.goal_distance_m = goal_distance(v);
    result_.walks = walks_;
    result_.trace.push_back({time_s, v.x, v.y, v.yaw, v.speed_mps, blocked_});
  }

  const World* world_;
  const VehicleConfig* config_;
  const RunRules rules_;
  Simulation* simulation_;
  Machinery* m_;
  Clock* clock_;
  Onlooker* onlooker_;
  TrueGeometry truth_;
  PeopleInView people_;
  WalkTimes walks_;
  RunResult result_;
  std::vector<Nanoseconds> took_;
  bool arrived_ = false;
  bool blocked_ = false;
  bool bumped_ = false;
  bool over_ = false;
  double next_trace_ = 0;
  double progress_x_ = 0;
  double progress_y_ = 0;
  double progress_time_ = -1;
  double stood_s_ = 0;
};

std::unique_ptr<StandIn> make_stand_in(const RunSettings& settings, const VehicleConfig& config, Simulation& s) {
  switch (settings.sensor) {
    case Sensor::stereo:
      return nullptr;
    case Sensor::truth:
      return std::make_unique<TrueDepth>(s.renderer(), s.camera(), max_disparity_px(config.matcher), s.shot());
    case Sensor::lidar2d:
      return std::make_unique<LevelLaser>(s.renderer(), s.camera().width, s.camera().height, s.shot());
    case Sensor::opencv_bm:
    case Sensor::opencv_sgbm:
      return settings.make_matcher(s.camera(), config);
  }
  return nullptr;
}

}  // namespace

RunResult run_world(const World& world, const VehicleConfig& config, const RunSettings& settings,
                    const KernelTable& kernels, Onlooker* onlooker) {
  if (config.loop.threads > 0) omp_set_num_threads(config.loop.threads);
  SteppedClock clock;
  const MonotonicClock machine_clock;
  SimulationSettings simulated = settings.simulation;
  simulated.draws = settings.sensor != Sensor::truth && settings.sensor != Sensor::lidar2d;
  Simulation simulation(simulated, world, config, clock);
  Machinery machinery(config, simulation.calibration(), simulation.devices(), kernels, clock, machine_clock);
  const std::unique_ptr<StandIn> stand_in = make_stand_in(settings, config, simulation);
  machinery.pipeline().stand_in(stand_in.get());
  Drive drive(world, config, settings.rules, simulation, machinery, clock, onlooker);
  if (onlooker != nullptr) onlooker->on_start(simulation, machinery);
  run_stepped(machinery, clock, {}, [&] { drive.after_turn(); });
  RunResult result = std::move(drive).result();
  result.world = world.name;
  result.seed = world.seed;
  result.sensor = kSensorNames[static_cast<std::size_t>(settings.sensor)];
  result.shortest_m = shortest_path_m(world, config.vehicle.radius_m);
  return result;
}

}  // namespace lakshya::sim
