#include "app/tools/device_check.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <vector>

namespace lakshya {
namespace {

constexpr double kPi = std::numbers::pi;
// Drives want their commands again and again; slow lines take 20 ms for one. A late one is no fault here.
constexpr Nanoseconds kControlPeriod = 40 * kMillisecond;
constexpr Nanoseconds kCommandTime = 150 * kMillisecond;
constexpr Nanoseconds kPatience = kSecond;  // for one reading

Nanoseconds nanoseconds(double seconds) {
  return std::llround(seconds * static_cast<double>(kSecond));
}
double seconds(Nanoseconds duration) {
  return static_cast<double>(duration) / static_cast<double>(kSecond);
}
double rounded(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

std::string fault_of(const Device& device, Status status, const std::string& doing) {
  const std::string problem = device.problem();
  return doing + ": " + to_string(status) + (problem.empty() ? "" : " (" + problem + ")");
}

void add_counters(const Device& device, DeviceCheck& check) {
  for (const Counter& counter : device.counters())
    check.facts["counters"][counter.name] = counter.value;
}

// ---- camera

double mean_grey(const ImageView<const std::uint8_t>& image) {
  std::uint64_t sum = 0;
  for (int v = 0; v < image.height; ++v) {
    for (const std::uint8_t grey : row_span(image, v))
      sum += grey;
  }
  return static_cast<double>(sum) / (static_cast<double>(image.width) * image.height);
}

// Enough to tell whether two images are the same, at no cost that would show in the frame rate.
std::uint64_t fingerprint(const ImageView<const std::uint8_t>& image) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (int v = 0; v < image.height; v += 8) {
    for (const std::uint8_t grey : row_span(image, v))
      hash = (hash ^ grey) * 1099511628211U;
  }
  return hash;
}

struct CameraNotes {
  int pairs = 0;
  int changes = 0;
  std::uint64_t lost = 0;
  Nanoseconds skew = 0;
  Nanoseconds first = 0;
  Nanoseconds last = 0;
  double left_grey = 0;
  double right_grey = 0;
  std::uint64_t print = 0;
  std::uint64_t sequence = 0;

  void add(const StereoFrame& frame) {
    const std::uint64_t now = fingerprint(frame.left);
    if (pairs == 0) {
      first = frame.left_time;
    } else {
      changes += now != print ? 1 : 0;
      lost += frame.sequence - sequence - 1;
    }
    ++pairs;
    print = now;
    sequence = frame.sequence;
    last = frame.left_time;
    skew = std::max(skew, std::abs(frame.left_time - frame.right_time));
    left_grey = mean_grey(frame.left);
    right_grey = mean_grey(frame.right);
  }
};

std::string camera_fault(const CameraNotes& notes, bool is_static) {
  constexpr double kBlack = 4;
  constexpr double kWhite = 251;
  for (const auto& [name, grey] : {std::pair{"left", notes.left_grey}, {"right", notes.right_grey}}) {
    if (grey < kBlack) return std::string(name) + " images are black (is the lens covered?)";
    if (grey > kWhite) return std::string(name) + " images are saturated (shorten the exposure)";
  }
  if (!is_static && notes.pairs > 2 && notes.changes == 0) return "frozen: every pair has the same left image";
  return {};
}

// ---- servo

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
  WheelTrial(Servo& servo, Clock& clock, DeviceCheck& check) : servo_(&servo), clock_(&clock), check_(&check) {}

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
    for (Nanoseconds next = clock_->now(); next < end; next += kControlPeriod) {
      clock_->sleep_until(next);
      if (!ok(servo_->drive(wanted, next + kCommandTime), step.name)) return false;
    }
    clock_->sleep_until(end);
    if (!ok(servo_->stop(clock_->now() + kPatience), "stop")) return false;
    clock_->sleep_until(clock_->now() + duration / 2);
    if (!read(after, step.name)) return false;
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
  DeviceCheck* check_;
};

}  // namespace

DeviceCheck check_camera(StereoCamera& camera, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = camera.open(); opened != Status::ok) {
    check.fault = fault_of(camera, opened, "open");
    return check;
  }
  CameraNotes notes;
  Status last = Status::ok;
  const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
  while (clock.now() < end && last != Status::end_of_data) {
    StereoFrame frame;
    const Status status = camera.capture(end, frame);
    if (status == Status::ok) {
      notes.add(frame);
    } else if (status != Status::timeout || notes.pairs == 0) {
      last = status;
    }
    // A camera that is gone answers at once.
    if (status == Status::disconnected) clock.sleep_until(clock.now() + 10 * kMillisecond);
  }
  check.facts["size"] = {camera.width(), camera.height()};
  check.facts["static"] = camera.is_static();
  check.facts["pairs"] = notes.pairs;
  if (notes.pairs > 1)
    check.facts["pairs_per_second"] =
        rounded((notes.pairs - 1) / std::max(seconds(notes.last - notes.first), 1e-9), 100);
  check.facts["lost"] = notes.lost;
  check.facts["skew_ms"] = rounded(seconds(notes.skew) * 1000, 1000);
  check.facts["mean_grey"] = {rounded(notes.left_grey, 10), rounded(notes.right_grey, 10)};
  add_counters(camera, check);
  check.fault = notes.pairs == 0 ? fault_of(camera, last == Status::ok ? Status::timeout : last, "no pair")
                                 : camera_fault(notes, camera.is_static());
  camera.close();
  return check;
}

DeviceCheck check_servo(Servo& servo, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = servo.open(); opened != Status::ok) {
    check.fault = fault_of(servo, opened, "open");
    return check;
  }
  check.facts["supervised"] = servo.is_supervised();
  check.facts["max_speed_mps"] = servo.max_speed_mps();
  WheelTrial trial(servo, clock, check);
  WheelTravel travel;
  if (settings.speed_mps <= 0) {
    const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
    while (trial.read(travel, "read travel") && clock.now() < end)
      clock.sleep_until(std::min(end, clock.now() + kSecond / 10));
  } else {
    const Nanoseconds duration = nanoseconds(settings.seconds / static_cast<double>(std::size(kSteps)));
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

DeviceCheck check_compass(Compass& compass, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = compass.open(); opened != Status::ok) {
    check.fault = fault_of(compass, opened, "open");
    return check;
  }
  int readings = 0;
  HeadingSample sample;
  Status last = Status::timeout;
  Nanoseconds first = 0;
  const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
  while (clock.now() < end) {
    HeadingSample next;
    const Status status = compass.read(end, next);
    if (status == Status::ok) {
      if (readings++ == 0) first = next.time;
      sample = next;
    } else if (status != Status::timeout) {
      last = status;
    }
    if (status == Status::disconnected) clock.sleep_until(clock.now() + 10 * kMillisecond);
  }
  const auto degrees = [](double angle) { return rounded(angle * 180 / kPi, 100); };
  check.facts["readings"] = readings;
  if (readings > 1)
    check.facts["readings_per_second"] =
        rounded((readings - 1) / std::max(seconds(sample.time - first), 1e-9), 100);
  if (readings > 0) {
    // As on a compass rose: clockwise from true north.
    check.facts["heading_deg"] = degrees(std::fmod(2.5 * kPi - sample.yaw, 2 * kPi));
    if (std::isfinite(sample.pitch)) check.facts["pitch_deg"] = degrees(sample.pitch);
    if (std::isfinite(sample.roll)) check.facts["roll_deg"] = degrees(sample.roll);
  } else {
    check.fault = fault_of(compass, last, "no reading");
  }
  add_counters(compass, check);
  compass.close();
  return check;
}

std::string device_check_text(const DeviceCheck& check) {
  std::ostringstream out;
  for (const auto& [name, value] : check.facts.items()) {
    if (name == "steps") {
      for (const auto& step : value)
        out << "  " << step["step"].get<std::string>() << ": wanted " << step["wanted_m"].dump() << " m, travelled "
            << step["travelled_m"].dump() << " m\n";
    } else if (value.is_object()) {
      out << "  " << name << ":";
      for (const auto& [key, count] : value.items())
        out << ' ' << key << ' ' << count.dump();
      out << '\n';
    } else {
      out << "  " << name << ": " << value.dump() << '\n';
    }
  }
  return out.str();
}

}  // namespace lakshya
