#include "hal/compass/iio_compass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "hal/compass/attitude.h"
#include "hal/compass/iio_text.h"

namespace lakshya {
namespace {

constexpr int kMostDevices = 32;
constexpr double kGravity = 9.80665;  // m/s^2
constexpr std::size_t kLongestRoot = 128;

enum { kBadReadings, kBadFields, kTimeouts, kDisconnections };

using Folder = std::array<char, kLongestRoot + 32>;

Folder folder_of(const std::string& root, int number) {
  Folder folder{};
  std::snprintf(folder.data(), folder.size(), "%s/iio:device%d", root.c_str(), number);
  return folder;
}

bool is_angle(double deg) {
  return deg >= -180 && deg <= 180;
}

bool is_finite(const Matrix3& m) {
  return std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); });
}

double length_of(const Vector3& v) {
  return std::sqrt(dot(v, v));
}

// About the up axis, counter-clockwise.
Matrix3 turned(double rad) {
  return {std::cos(rad), -std::sin(rad), 0, std::sin(rad), std::cos(rad), 0, 0, 0, 1};
}

}  // namespace

IioCompass::IioCompass(IioCompassSettings settings, SystemCalls& calls, Clock& clock)
    : settings_(std::move(settings)), calls_(&calls), clock_(&clock), magnetometer_(calls), accelerometer_(calls) {}

IioCompass::~IioCompass() {
  IioCompass::close();
}

Status IioCompass::check_settings() {
  const IioCompassSettings& s = settings_;
  const struct {
    bool holds;
    const char* otherwise;
  } rules[] = {
      {s.root.size() <= kLongestRoot, "root is longer than 128 characters"},
      {s.rate_hz >= 0.1 && s.rate_hz <= 100, "rate_hz is not 0.1 to 100"},
      {is_rotation(s.axes), "axes is no rotation"},
      {std::isfinite(dot(s.hard_iron, s.hard_iron)), "hard_iron is not finite"},
      {is_finite(s.soft_iron) && determinant(s.soft_iron) > 0, "soft_iron has no determinant above 0"},
      {is_angle(s.declination_deg), "declination_deg is not -180 to 180"},
      {is_angle(s.mounting_deg), "mounting_deg is not -180 to 180"},
      {s.min_horizontal_gauss > 0, "min_horizontal_gauss is not above 0"},
      {s.max_horizontal_gauss > s.min_horizontal_gauss, "max_horizontal_gauss is not above the least"},
      {s.saturated_raw >= 0, "saturated_raw is below 0"},
  };
  for (const auto& rule : rules) {
    if (rule.holds) continue;
    problem_.set("magnetometer: settings: %s", rule.otherwise);
    return Status::bad_argument;
  }
  return Status::ok;
}

bool IioCompass::has_name(const char* folder, const std::string& name) {
  std::array<char, 128> text{};
  int error = 0;
  const std::string_view read = read_attribute(*calls_, folder, "name", text, error);
  return error == 0 && without_blanks(read) == name;
}

Status IioCompass::find() {
  const std::string& name = settings_.name;
  for (int number = 0; number < kMostDevices; ++number) {
    const Folder folder = folder_of(settings_.root, number);
    if (!(name.empty() ? magnetometer_.exists(folder.data(), "magn") : has_name(folder.data(), name))) continue;
    const Status status = magnetometer_.open(folder.data(), "magn", problem_);
    return status == Status::ok ? find_accelerometer(folder.data()) : status;
  }
  problem_.set("%s: no %s", settings_.root.c_str(), name.empty() ? "magnetometer" : name.c_str());
  return Status::disconnected;
}

Status IioCompass::find_accelerometer(const char* own_folder) {
  const std::string& name = settings_.accelerometer;
  if (name == "none") return Status::ok;
  if (name.empty()) {
    return accelerometer_.exists(own_folder, "accel") ? accelerometer_.open(own_folder, "accel", problem_)
                                                      : Status::ok;
  }
  for (int number = 0; number < kMostDevices; ++number) {
    const Folder folder = folder_of(settings_.root, number);
    if (has_name(folder.data(), name)) return accelerometer_.open(folder.data(), "accel", problem_);
  }
  problem_.set("%s: no %s", settings_.root.c_str(), name.c_str());
  return Status::disconnected;
}

void IioCompass::forget() {
  magnetometer_.close();
  accelerometer_.close();
}

Status IioCompass::open() {
  close();
  Status status = check_settings();
  if (status == Status::ok) status = find();
  FieldSample first;
  if (status == Status::ok) status = measure(first);
  if (status != Status::ok) {
    forget();
    return status;
  }
  is_open_ = true;
  next_sample_ = clock_->now();
  return Status::ok;
}

void IioCompass::close() {
  is_open_ = false;
  forget();
}

Status IioCompass::refuse(const char* what, double value) {
  ++counters_[kBadFields].value;
  problem_.set("magnetometer: %s %.3g", what, value);
  return Status::bad_data;
}

Status IioCompass::lose_or_count(Status status) {
  ++counters_[status == Status::disconnected ? kDisconnections : kBadReadings].value;
  if (status == Status::disconnected) {
    forget();
    retry_.lost(clock_->now());
  }
  return status;
}

Status IioCompass::measure(FieldSample& sample) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Vector3 raw{};
  Vector3 value{};
  const Nanoseconds before = clock_->now();
  Status status = magnetometer_.read(raw, value, problem_);
  if (status != Status::ok) return lose_or_count(status);
  sample.time = before + (clock_->now() - before) / 2;
  sample.field_gauss = settings_.axes * value;
  for (const double number : raw) {
    if (settings_.saturated_raw > 0 && std::abs(number) >= settings_.saturated_raw)
      return refuse("saturated at", number);
  }
  sample.acceleration = {kNone, kNone, kNone};
  if (!accelerometer_.is_open()) return Status::ok;
  status = accelerometer_.read(raw, value, problem_);
  if (status != Status::ok) return lose_or_count(status);
  sample.acceleration = settings_.axes * value;
  const double length = length_of(value);
  if (!(length >= 0.5 * kGravity && length <= 2 * kGravity)) return refuse("acceleration in m/s^2 is", length);
  return Status::ok;
}

bool IioCompass::look_again(Nanoseconds deadline) {
  if (!retry_.wait(*clock_, deadline)) return false;
  if (find() == Status::ok) return true;
  forget();
  return false;
}

Status IioCompass::read_field(Nanoseconds deadline, FieldSample& sample) {
  if (!is_open_) {
    problem_.set("magnetometer: is not open");
    return Status::disconnected;
  }
  if (!magnetometer_.is_open() && !look_again(deadline)) return Status::disconnected;
  clock_->sleep_until(std::min(deadline, next_sample_));
  const Nanoseconds now = clock_->now();
  if (now < next_sample_) {
    ++counters_[kTimeouts].value;
    problem_.set("magnetometer: the next sample is due after the deadline");
    return Status::timeout;
  }
  const auto period = static_cast<Nanoseconds>(kSecond / settings_.rate_hz);
  next_sample_ = next_sample_ + period > now ? next_sample_ + period : now + period;
  return measure(sample);
}

Status IioCompass::read(Nanoseconds deadline, HeadingSample& sample) {
  FieldSample measured;
  const Status status = read_field(deadline, measured);
  if (status != Status::ok) return status;
  const Matrix3 mounting = turned(settings_.mounting_deg * kRadiansPerDegree);
  const bool has_tilt = accelerometer_.is_open();
  const Vector3 field = mounting * (settings_.soft_iron * (measured.field_gauss - settings_.hard_iron));
  const Vector3 up = has_tilt ? mounting * measured.acceleration : Vector3{0, 0, 1};
  double horizontal = 0;
  HeadingSample found = attitude_of(field, up, horizontal);
  if (!(horizontal >= settings_.min_horizontal_gauss && horizontal <= settings_.max_horizontal_gauss))
    return refuse("horizontal field in gauss is", horizontal);
  if (!has_tilt) found.pitch = found.roll = std::numeric_limits<double>::quiet_NaN();
  found.yaw = wrapped_angle(found.yaw - settings_.declination_deg * kRadiansPerDegree);
  found.time = measured.time;
  sample = found;
  return Status::ok;
}

}  // namespace lakshya
