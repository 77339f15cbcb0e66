// What must hold between values, after every source of values has been applied.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/core/vehicle_config.h"

namespace lakshya {

struct Contradiction {
  std::vector<std::string_view> keys;  // dotted names of the values that disagree
  std::string reason;                  // "key: reason (what to do)"
};

// The first contradiction, or none. Expects every value inside its own range (vehicle_config_keys.h).
std::optional<Contradiction> find_contradiction(const VehicleConfig& config);

}  // namespace lakshya
