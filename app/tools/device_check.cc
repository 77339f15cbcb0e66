#include "app/tools/device_check.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <utility>

#include "app/tools/device_check_parts.h"

namespace lakshya {

using namespace device_check;  // NOLINT(google-build-using-namespace): our own parts

namespace {

constexpr double kPi = std::numbers::pi;
constexpr Nanoseconds kSilence = kSecond;  // of a device that should be giving samples

// What comes of a device that gives samples until `end`: how many, and whether it still did at the end.
struct Samples {
  int count = 0;
  Nanoseconds first = 0;  // arrivals
  Nanoseconds last = 0;
  Status failure = Status::timeout;  // the last one
  bool interrupted = false;

  // `take` waits for one until the time given. Returns at the end, after the end of a recording, and when interrupted.
  template <class Take>
  void collect(Clock& clock, Nanoseconds end, const CheckSettings& settings, Take take) {
    while (clock.now() < end && failure != Status::end_of_data && !(interrupted = lakshya::interrupted(settings))) {
      const Status status = take(std::min(end, clock.now() + kSilence));
      if (status == Status::ok) {
        last = clock.now();
        if (count++ == 0) first = last;
      } else if (status != Status::timeout || count == 0) {
        failure = status;
      }
      // A device that is gone answers at once.
      if (status == Status::disconnected) clock.sleep_until(clock.now() + kMillisecond * 10);
    }
  }

  std::string fault(const Device& device, Nanoseconds end) const {
    if (interrupted) return "interrupted";
    if (count == 0) return fault_of(device, failure, "nothing came");
    const Nanoseconds usual = count > 1 ? (last - first) / (count - 1) : 0;
    if (failure == Status::end_of_data || end - last <= std::max(kSilence, 3 * usual)) return {};
    return fault_of(device, failure, "nothing came any more");
  }
};

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

}  // namespace

DeviceCheck check_camera(StereoCamera& camera, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = camera.open(); opened != Status::ok) {
    check.fault = fault_of(camera, opened, "open");
    return check;
  }
  CameraNotes notes;
  Samples samples;
  const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
  samples.collect(clock, end, settings, [&](Nanoseconds deadline) {
    StereoFrame frame;
    const Status status = camera.capture(deadline, frame);
    if (status == Status::ok) notes.add(frame);
    return status;
  });
  check.facts["size"] = {camera.width(), camera.height()};
  check.facts["static"] = camera.is_static();
  check.facts["pairs"] = notes.pairs;
  if (notes.pairs > 1) {
    check.facts["pairs_per_second"] =
        rounded((notes.pairs - 1) / std::max(seconds(notes.last - notes.first), 1e-9), 100);
  }
  check.facts["lost"] = notes.lost;
  check.facts["skew_ms"] = rounded(seconds(notes.skew) * 1000, 1000);
  check.facts["mean_grey"] = {rounded(notes.left_grey, 10), rounded(notes.right_grey, 10)};
  add_counters(camera, check);
  check.fault = samples.fault(camera, end);
  if (check.fault.empty()) check.fault = camera_fault(notes, camera.is_static());
  camera.close();
  return check;
}

DeviceCheck check_compass(Compass& compass, Clock& clock, const CheckSettings& settings) {
  DeviceCheck check;
  if (const Status opened = compass.open(); opened != Status::ok) {
    check.fault = fault_of(compass, opened, "open");
    return check;
  }
  HeadingSample sample;
  Nanoseconds first = 0;
  Samples samples;
  const Nanoseconds end = clock.now() + nanoseconds(settings.seconds);
  samples.collect(clock, end, settings, [&](Nanoseconds deadline) {
    HeadingSample next;
    const Status status = compass.read(deadline, next);
    if (status != Status::ok) return status;
    if (samples.count == 0) first = next.time;
    sample = next;
    return status;
  });
  const auto degrees = [](double angle) { return rounded(angle * 180 / kPi, 100); };
  check.facts["readings"] = samples.count;
  if (samples.count > 1) {
    check.facts["readings_per_second"] =
        rounded((samples.count - 1) / std::max(seconds(sample.time - first), 1e-9), 100);
  }
  if (samples.count > 0) {
    // As on a compass rose: clockwise from true north.
    check.facts["heading_deg"] = degrees(std::fmod(2.5 * kPi - sample.yaw, 2 * kPi));
    if (std::isfinite(sample.pitch)) check.facts["pitch_deg"] = degrees(sample.pitch);
    if (std::isfinite(sample.roll)) check.facts["roll_deg"] = degrees(sample.roll);
  }
  check.fault = samples.fault(compass, end);
  add_counters(compass, check);
  compass.close();
  return check;
}

std::string device_check_text(const DeviceCheck& check) {
  std::ostringstream out;
  for (const auto& [name, value] : check.facts.items()) {
    if (name == "steps") {
      for (const auto& step : value) {
        out << "  " << step["step"].get<std::string>() << ": wanted " << step["wanted_m"].dump() << " m, travelled "
            << step["travelled_m"].dump() << " m\n";
      }
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
