#include "app/core/vehicle_config_check.h"

#include <utility>

#include "app/core/vehicle_config_text.h"

namespace lakshya {
namespace {

struct Value {
  std::string_view key;
  double value = 0;
};

// "a.b: 1 + c.d (2)" when it opens a message, else "a.b (1) + c.d (2)".
std::string sum_text(const std::vector<Value>& values, bool opening) {
  std::string text;
  for (const Value& v : values) {
    const bool first = text.empty();
    text.append(first ? "" : " + ").append(v.key);
    text.append(first && opening ? ": " + number_text(v.value) : " (" + number_text(v.value) + ")");
  }
  return text;
}

enum class Order { less, less_or_equal };

// The sum of `small` against the sum of `large`.
struct Rule {
  std::vector<Value> small;
  Order order = Order::less;
  std::vector<Value> large;
  std::string_view why;
};

double sum(const std::vector<Value>& values) {
  double total = 0;
  for (const Value& v : values)
    total += v.value;
  return total;
}

bool holds(const Rule& rule) {
  return rule.order == Order::less ? sum(rule.small) < sum(rule.large) : sum(rule.small) <= sum(rule.large);
}

Contradiction contradiction(const Rule& rule) {
  Contradiction result;
  for (const Value& v : rule.small)
    result.keys.push_back(v.key);
  for (const Value& v : rule.large)
    result.keys.push_back(v.key);
  const char* relation = rule.order == Order::less ? " must be less than " : " must not be more than ";
  result.reason = sum_text(rule.small, true) + relation + sum_text(rule.large, false) + ": " +
                  std::string(rule.why) + " (change one of them)";
  return result;
}

std::vector<Rule> rules(const VehicleConfig& c) {
  const Value tolerance{"prune.floor_tolerance_m", c.prune.floor_tolerance_m};
  const Value clearance{"prune.clearance_m", c.prune.clearance_m};
  const Value target{"planner.cost_target", c.planner.cost_target};
  return {
      {{tolerance}, Order::less, {{"camera.height_m", c.camera.height_m}}, "the floor's bound needs it"},
      {{tolerance}, Order::less, {clearance}, "no height would be left for obstacles"},
      {{{"score.min_height_m", c.score.min_height_m}},
       Order::less,
       {clearance},
       "no cell could become an obstacle"},
      {{{"matcher.p1", static_cast<double>(c.matcher.p1)}},
       Order::less_or_equal,
       {{"matcher.p2_min", static_cast<double>(c.matcher.p2_min)}},
       "a large disparity step costs at least as much as a small one"},
      {{{"matcher.p2_min", static_cast<double>(c.matcher.p2_min)}},
       Order::less_or_equal,
       {{"matcher.p2", static_cast<double>(c.matcher.p2)}},
       "P2 falls from p2 to p2_min"},
      {{{"planner.threshold_low", static_cast<double>(c.planner.threshold_low)}},
       Order::less_or_equal,
       {{"planner.threshold_high", static_cast<double>(c.planner.threshold_high)}},
       "a sector would be free and blocked at once"},
      {{{"planner.cost_heading", c.planner.cost_heading}, {"planner.cost_previous", c.planner.cost_previous}},
       Order::less,
       {target},
       "the vehicle would not follow its target"},
      {{{"vehicle.radius_m", c.vehicle.radius_m}, {"vehicle.safety_distance_m", c.vehicle.safety_distance_m}},
       Order::less,
       {{"planner.active_radius_m", c.planner.active_radius_m}},
       "every obstacle in sight would already be inside the safety distance"},
  };
}

}  // namespace

std::optional<Contradiction> find_contradiction(const VehicleConfig& config) {
  for (const Rule& rule : rules(config)) {
    if (!holds(rule)) return contradiction(rule);
  }
  return std::nullopt;
}

}  // namespace lakshya
