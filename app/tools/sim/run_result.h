// What one simulated drive was like.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/tools/sim/walk.h"

namespace lakshya::sim {

enum class Ending : std::uint8_t { reached, collision, dropoff, stuck, timeout };

inline constexpr std::array<std::string_view, 5> kEndingNames{"reached", "collision", "dropoff", "stuck",
                                                              "timeout"};

// Where the vehicle really was, ten times a second.
struct TracePoint {
  double time_s = 0;
  double x = 0;  // m, world frame
  double y = 0;
  double yaw = 0;  // rad
  double speed_mps = 0;
  bool blocked = false;  // the newest plan found no way
};

struct RunResult {
  std::string world;
  std::uint64_t seed = 0;
  std::string sensor;
  Ending ending = Ending::timeout;
  std::string hit;       // name of what was hit: "table 3"; empty: nothing
  std::string hit_kind;  // its class: "table"
  // Not held against the vehicle: a person whom it had not seen for a second, or glass.
  std::string excuse;
  double time_s = 0;
  double path_m = 0;
  double shortest_m = 0;       // of a disc of the vehicle's size, through true geometry
  double min_clearance_m = 0;  // between the body's side and the nearest obstacle, over the whole run
  double mean_speed_mps = 0;
  std::uint64_t false_stops = 0;  // stood for half a second although the true way ahead was free (see run_world.h)
  std::uint64_t bumps = 0;        // somebody walked into the standing vehicle
  std::uint64_t frames = 0;
  double frame_ms_p50 = 0;  // of the pipeline, on the machine's clock
  double frame_ms_p99 = 0;
  double goal_distance_m = 0;  // true, at the end
  std::vector<TracePoint> trace;
  WalkTimes walks;  // at the end; not part of the JSON

  // Held against the vehicle.
  bool is_collision() const { return ending == Ending::collision && excuse.empty(); }
};

// One line of the campaign's output, without the trace.
nlohmann::ordered_json run_json(const RunResult& result);
// Throws std::invalid_argument for what run_json did not write.
RunResult run_from_json(const nlohmann::ordered_json& json);

// {"summary":true,"runs":..,"reached":..,"collisions":..,...}
nlohmann::ordered_json summary_json(const std::vector<RunResult>& results);

}  // namespace lakshya::sim
