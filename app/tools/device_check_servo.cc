// Drives: each wheel, both ways.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/tools/device_check.h"
#include "app/tools/device_check_parts.h"

namespace lakshya {

using namespace device_check;  // NOLINT(google-build-using-namespace): our own parts

namespace {

// Drives want their commands again and again; slow lines take 20 ms for one. A late one is no fault here.
constexpr Nanoseconds kControlPeriod = 40 * kMillisecond;
constexpr Nanoseconds kCommandTime = 150 * kMillisecond;
constexpr double kSlowestAcceleration = 0.5;       // m/s^2
constexpr Nanoseconds kTimeToRest = 6 * kSecond;   // from 2 m/s, with some to spare
constexpr Nanoseconds kLook = 100 * kMillisecond;  // between two looks at wheels that come to rest
constexpr Nanoseconds kPatience = kSecond;         // for one reading

struct Step {
  const char* name;
  double left;  // in speeds
  double right;
};
constexpr Step kSteps[] = {{"left wheel forward", 1, 0},  {"left wheel back", -1, 0},
                           {"right wheel forward", 0, 1}, {"right wheel back", 0, -1},
                           {"both wheels forward", 1, 1}, {"both wheels back", -1, -1}};

class WheelTrial {
 public:
  WheelTrial(Servo& servo, Clock& clock, const CheckSettings& settings, DeviceCheck& check)
      : servo_(&servo), clock_(&clock), settings_(&settings), check_(&check) {}

  bool read(WheelTravel& travel, const char* doing) {
    return ok(servo_->read_travel(clock_->now() + kPatience, travel), doing);
  }

  // Drives for a while, stops, waits until the wheels have stopped; adds a line with what was wanted and what was measured.
  bool run(const Step& step, double speed_mps, Nanoseconds duration) {
    WheelTravel before;
    WheelTravel after;
    if (!read(before, step.name)) return false;
    const WheelVelocities wanted{step.left * speed_mps, step.right * speed_mps};
    const Nanoseconds end = clock_->now() + duration;
    for (Nanoseconds next = clock_->now(); next < end; next = std::max(next + kControlPeriod, clock_->now())) {
      clock_->sleep_until(next);
      if (is_interrupted()) return false;
      if (!ok(servo_->drive(wanted, next + kCommandTime), step.name)) return false;
    }
    clock_->sleep_until(end);
    if (!ok(servo_->stop(clock_->now() + kPatience), "stop")) return false;
    if (!come_to_rest(after, step.name)) return false;
    const double left = after.left_m - before.left_m;
    const double right = after.right_m - before.right_m;
    const double time = seconds(duration);
    check_->facts["steps"].push_back(
        {{"step", step.name},
         {"wanted_m", {rounded(wanted.left_mps * time, 1e4), rounded(wanted.right_mps * time, 1e4)}},
         {"travelled_m", {rounded(left, 1e4), rounded(right, 1e4)}}});
    if (!after.measured || (as_wanted(left, wanted.left_mps * time) && as_wanted(right, wanted.right_mps * time)))
      return true;
    check_->fault = std::string(step.name) +
                    ": the wheels did not go where they should (compare wanted_m and travelled_m: " +
                    "gear ratio, wheel radius, directions, left and right swapped?)";
    return false;
  }

 private:
  bool is_interrupted() {
    if (!interrupted(*settings_)) return false;
    check_->fault = "interrupted";
    return true;
  }

  bool come_to_rest(WheelTravel& travel, const char* doing) {
    const Nanoseconds end = clock_->now() + kTimeToRest;
    if (!read(travel, doing)) return false;
    while (travel.measured && clock_->now() < end && !is_interrupted()) {
      const WheelTravel before = travel;
      clock_->sleep_until(clock_->now() + kLook);
      if (!read(travel, doing)) return false;
      if (travel.left_m == before.left_m && travel.right_m == before.right_m) break;
    }
    return check_->fault.empty();
  }

  // Within a fifth, or two millimetres for the way of speeding up and slowing down.
  static bool as_wanted(double way, double wanted) {
    return std::abs(way - wanted) <= 0.2 * std::abs(wanted) + 0.002;
  }

  bool ok(Status status, const char* doing) {
    if (status != Status::ok) check_->fault = fault_of(*servo_, status, doing);
    return status == Status::ok;
  }

  Servo* servo_;
  Clock* clock_;
  const CheckSettings* settings_;
  DeviceCheck* check_;
};

}  // namespace

DeviceCheck check_servo(Servo& servo, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = servo.open(); opened != Status::ok) {
    check.fault = fault_of(servo, opened, "open");
    return check;
  }
  check.facts["supervised"] = servo.is_supervised();
  check.facts["max_speed_mps"] = servo.max_speed_mps();
  WheelTrial trial(servo, clock, settings, check);
  WheelTravel travel;
  if (settings.speed_mps <= 0) {
    const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
    while (trial.read(travel, "read travel") && clock.now() < end && !interrupted(settings))
      clock.sleep_until(std::min(end, clock.now() + kLook));
  } else {
    const Nanoseconds duration = nanoseconds(std::max(settings.seconds / static_cast<double>(std::size(kSteps)),
                                                      2 * settings.speed_mps / kSlowestAcceleration));
    for (const Step& step : kSteps) {
      if (!trial.run(step, settings.speed_mps, duration)) break;
    }
    if (check.fault.empty()) (void)trial.read(travel, "read travel");
  }
  check.facts["measures_travel"] = travel.measured;
  check.facts["travel_m"] = {rounded(travel.left_m, 1e4), rounded(travel.right_m, 1e4)};
  add_counters(servo, check);
  servo.close();
  return check;
}

}  // namespace lakshya
