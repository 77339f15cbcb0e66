// Private to the checks of devices: what they share.
#pragma once

#include <cmath>
#include <string>

#include "app/tools/device_check.h"

namespace lakshya::device_check {

inline Nanoseconds nanoseconds(double seconds) {
  return std::llround(seconds * static_cast<double>(kSecond));
}
inline double seconds(Nanoseconds duration) {
  return static_cast<double>(duration) / static_cast<double>(kSecond);
}
inline double rounded(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit + 0.0;  // no "-0.0"
}

inline std::string fault_of(const Device& device, Status status, const std::string& doing) {
  const std::string problem = device.problem();
  return doing + ": " + to_string(status) + (problem.empty() ? "" : " (" + problem + ")");
}

inline bool interrupted(const CheckSettings& settings) {
  return settings.interrupt != nullptr && settings.interrupt->load();
}

inline void add_counters(const Device& device, DeviceCheck& check) {
  for (const Counter& counter : device.counters())
    check.facts["counters"][counter.name] = counter.value;
}

}  // namespace lakshya::device_check
