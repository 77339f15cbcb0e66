#include "app/tools/plan_report.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

#include "app/nav/sectors.h"

namespace lakshya {
namespace {

constexpr int kSectorsToTheSide = kPolarSectors / 4;

// Adding 0 turns -0 into 0.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

const char* side_name(Side side) {
  return side == Side::left ? "left" : "right";
}

std::vector<std::uint32_t> front_histogram(const Plan& plan) {
  std::vector<std::uint32_t> front;
  for (int k = -kSectorsToTheSide; k <= kSectorsToTheSide; ++k) {
    front.push_back(plan.histogram[sector_index(k)]);
  }
  return front;
}

}  // namespace

nlohmann::ordered_json plan_json(const Plan& plan, const PlannerParams& params) {
  using Json = nlohmann::ordered_json;
  Json openings = Json::array();
  for (const Opening& opening : plan.openings.view()) {
    openings.push_back({rounded(degrees(opening.left_edge())), rounded(degrees(opening.right_edge()))});
  }
  Json json;
  json["planner"] = params.name;
  json["direction_deg"] = plan.blocked ? Json() : Json(rounded(degrees(plan.direction)));
  json["speed_mps"] = rounded(plan.speed_mps);
  json["turn_rate_dps"] = rounded(degrees(plan.turn_rate_rps));
  json["clear_distance_m"] = rounded(plan.clear_distance_m);
  json["blocked"] = plan.blocked;
  json["recovery_turn"] = plan.blocked ? Json(side_name(plan.recovery)) : Json();
  json["openings"] = openings;
  json["histogram"] = front_histogram(plan);
  const Thresholds thresholds = histogram_thresholds(params);
  json["threshold_low"] = thresholds.low;
  json["threshold_high"] = thresholds.high;
  return json;
}

std::string plan_command_text(const Plan& plan) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2);
  if (plan.blocked) {
    out << "  blocked: stop, then turn " << side_name(plan.recovery) << '\n';
    return out.str();
  }
  out << "  direction      " << std::setw(8) << rounded(degrees(plan.direction)) << " deg\n"
      << "  speed          " << std::setw(8) << rounded(plan.speed_mps) << " m/s\n"
      << "  turn rate      " << std::setw(8) << rounded(degrees(plan.turn_rate_rps)) << " deg/s\n"
      << "  clear distance " << std::setw(8) << rounded(plan.clear_distance_m) << " m, then "
      << (plan.clear_end == ClearEnd::obstacle ? "an obstacle" : "unknown") << '\n';
  return out.str();
}

}  // namespace lakshya
