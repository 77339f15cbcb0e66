#include "hal/servo/quicksilver_settings.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "hal/servo/quicksilver_protocol.h"

namespace lakshya {
namespace {

constexpr int kFirstUserRegister = 11;
constexpr int kLastUserRegister = 198;

// Also false for NaN.
bool is_within(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;
}

Status refuse(Problem& problem, const char* what, double value) {
  problem.set("drives: %s: %g is not possible", what, value);
  return Status::bad_argument;
}

Status check_wheel(const QuickSilverWheel& wheel, Problem& problem) {
  if (wheel.address < 1 || wheel.address > 254) return refuse(problem, "address", wheel.address);
  if (wheel.direction != 1 && wheel.direction != -1) return refuse(problem, "direction", wheel.direction);
  if (!is_within(wheel.radius_m, 0.01, 2)) return refuse(problem, "radius_m", wheel.radius_m);
  if (!is_within(wheel.gear_ratio, 0.01, 1000)) return refuse(problem, "gear_ratio", wheel.gear_ratio);
  if (!is_within(wheel.counts_per_rev, 100, 1000000))
    return refuse(problem, "counts_per_rev", wheel.counts_per_rev);
  return Status::ok;
}

Status check_limits(const QuickSilverSettings& settings, const QuickSilverWheel& wheel, Problem& problem) {
  const double rpm_per_mps = std::abs(motor_rpm_per_mps(wheel));
  std::int32_t units = 0;
  if (!(settings.max_speed_mps > 0) ||
      quicksilver::velocity_units(settings.max_speed_mps * rpm_per_mps, units) != Status::ok) {
    return refuse(problem, "max_speed_mps", settings.max_speed_mps);
  }
  if (quicksilver::acceleration_units(settings.max_acceleration_mps2 * rpm_per_mps / 60, units) != Status::ok)
    return refuse(problem, "max_acceleration_mps2", settings.max_acceleration_mps2);
  return Status::ok;
}

Status check_registers(const QuickSilverSettings& settings, Problem& problem) {
  const std::array<int, 5> registers = {settings.velocity_register - 1, settings.velocity_register,
                                        settings.counter_register, settings.heartbeat_register,
                                        settings.signature_register};
  for (std::size_t i = 0; i < registers.size(); ++i) {
    if (!is_within(registers[i], kFirstUserRegister, kLastUserRegister))
      return refuse(problem, "register", registers[i]);
    for (std::size_t other = 0; other < i; ++other) {
      if (registers[i] == registers[other]) return refuse(problem, "register used twice", registers[i]);
    }
  }
  return Status::ok;
}

Status check_times(const QuickSilverSettings& settings, Problem& problem) {
  if (!is_within(settings.watchdog_s, 0.05, 1)) return refuse(problem, "watchdog_s", settings.watchdog_s);
  if (!is_within(settings.answer_timeout_s, 0.005, 0.5))
    return refuse(problem, "answer_timeout_s", settings.answer_timeout_s);
  if (!is_within(settings.quiet_s, 0.005, 0.5)) return refuse(problem, "quiet_s", settings.quiet_s);
  return Status::ok;
}

}  // namespace

Nanoseconds as_nanoseconds(double seconds) {
  return is_within(seconds, 0, 10) ? static_cast<Nanoseconds>(seconds * kSecond) : 0;
}

double motor_rpm_per_mps(const QuickSilverWheel& wheel) {
  return 60 * wheel.gear_ratio * wheel.direction / (2 * std::numbers::pi * wheel.radius_m);
}

double metres_per_count(const QuickSilverWheel& wheel) {
  return 2 * std::numbers::pi * wheel.radius_m * wheel.direction / (wheel.gear_ratio * wheel.counts_per_rev);
}

Status check_settings(const QuickSilverSettings& settings, Problem& problem) {
  for (const QuickSilverWheel* wheel : {&settings.left, &settings.right}) {
    const Status wheel_is = check_wheel(*wheel, problem);
    if (wheel_is != Status::ok) return wheel_is;
    const Status limits_are = check_limits(settings, *wheel, problem);
    if (limits_are != Status::ok) return limits_are;
  }
  if (settings.left.address == settings.right.address)
    return refuse(problem, "address of both drives", settings.left.address);
  if (!(settings.v_unsupervised_mps >= 0))
    return refuse(problem, "v_unsupervised_mps", settings.v_unsupervised_mps);
  const Status registers_are = check_registers(settings, problem);
  return registers_are != Status::ok ? registers_are : check_times(settings, problem);
}

}  // namespace lakshya
