// A plan as JSON and as text: the same words in `plan` and in `process`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/nav/planner.h"

namespace lakshya {

// planner (its name), direction_deg (null when blocked), speed_mps, turn_rate_dps, clear_distance_m, blocked, recovery_turn, openings,
// histogram (37 sectors from -90 to 90 degrees), threshold_low, threshold_high. Rounded to a millionth, which is
// what two machines agree on (docs/contract.md).
nlohmann::ordered_json plan_json(const Plan& plan, const PlannerParams& params);

// Direction, speed, turn rate and clear distance, or where to turn when blocked; one line each.
std::string plan_command_text(const Plan& plan);

}  // namespace lakshya
