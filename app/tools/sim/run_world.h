// The firmware's own loop drives a simulated vehicle through a world, on the virtual clock, until something ends it.
#pragma once

#include <functional>
#include <memory>

#include "app/core/kernel_table.h"
#include "app/loop/messages.h"
#include "app/tools/sim/run_result.h"
#include "app/tools/sim/simulation.h"

namespace lakshya::sim {

// What ends a drive, and what counts:
//  reached    the loop says that all way points are reached, and the last one is truly within goal_tolerance_m and goal_drift of the
//             way: wheels and compass alone do not know better where they are
//  collision  the body touches an obstacle. Excused: glass; a person who was not in view for person_seen_s of the last
//             person_memory_s seconds; contact while the vehicle stands is no collision but a bump.
//  dropoff    a wheel or a caster gets over a drop-off
//  stuck      less than stuck_way_m of way in stuck_s seconds
//  timeout    World::time_limit_s is over
// A false stop: the vehicle stands for false_stop_s, before its last way point, although a body of its radius could go on straight
// ahead for false_stop_clear_m.
struct RunRules {
  double goal_tolerance_m = 0.8;
  double goal_drift = 0.05;  // metres per metre of way
  double person_seen_s = 1;
  double person_memory_s = 4;
  double stuck_way_m = 0.3;
  double stuck_s = 25;
  double false_stop_s = 0.5;
  double false_stop_clear_m = 2;
  double body_bottom_m = 0.05;  // lower things are driven over
};

enum class Sensor : std::uint8_t { stereo, opencv_bm, opencv_sgbm, lidar2d, truth };
inline constexpr std::array<std::string_view, 5> kSensorNames{"stereo", "opencv-bm", "opencv-sgbm", "lidar2d",
                                                              "truth"};

struct RunSettings {
  SimulationSettings simulation;
  RunRules rules;
  Sensor sensor = Sensor::stereo;
  // For the OpenCV sensors, which this library knows nothing of.
  std::function<std::unique_ptr<StandIn>(const RectifiedGeometry& camera, const VehicleConfig& config)>
      make_matcher;
};

// Looks on while a run goes on; is called within the loop and must not change it.
class Onlooker {
 public:
  virtual ~Onlooker() = default;
  // Before the first turn; both outlive the run.
  virtual void on_start(Simulation& /*simulation*/, const Machinery& /*machinery*/) {}
  virtual void on_frame(const FrameResult& /*frame*/, const PlanNote& /*plan*/, const Shot& /*shot*/) {}
  virtual void on_turn(const StatusNote& /*status*/, const VehicleState& /*vehicle*/) {}
  virtual void on_state(const StateNote& /*note*/) {}
};

// Throws InputError where the loop cannot begin.
RunResult run_world(const World& world, const VehicleConfig& config, const RunSettings& settings,
                    const KernelTable& kernels, Onlooker* onlooker = nullptr);

}  // namespace lakshya::sim
