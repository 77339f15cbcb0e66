#include "app/tools/soak_devices.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/core/input_error.h"
#include "app/core/recorded_folder.h"
#include "hal/angle.h"
#include "hal/camera/folder_camera.h"
#include "hal/compass/sim_compass.h"

namespace lakshya {
namespace {

constexpr std::size_t kMostKeptBytes = 512'000'000;

void copy(ImageView<const std::uint8_t> from, ImageView<std::uint8_t> to) {
  for (int v = 0; v < from.height; ++v)
    std::ranges::copy(row_span(from, v), to.row(v));
}

void fill(ImageView<std::uint8_t> image, std::uint8_t value) {
  for (int v = 0; v < image.height; ++v)
    std::ranges::fill(row_span(image, v), value);
}

class FaultyCamera final : public StereoCamera {
 public:
  FaultyCamera(std::unique_ptr<StereoCamera> inner, const SafetyConfig& safety, FaultPlan& plan, Clock& clock)
      : inner_(std::move(inner)),
        skew_(std::llround(3 * safety.skew_s * static_cast<double>(kSecond)) + kMillisecond),
        plan_(&plan),
        clock_(&clock) {}

  Status open() override {
    const Status status = inner_->open();
    if (status != Status::ok) {
      problem_.set("%s", inner_->problem());
      return status;
    }
    for (Image<std::uint8_t>* image : {&dark_, &bright_, &frozen_left_, &frozen_right_})
      *image = Image<std::uint8_t>(width(), height());
    fill(bright_.view(), 255);
    return status;
  }
  void close() override { inner_->close(); }
  std::span<const Counter> counters() const override { return inner_->counters(); }
  int width() const override { return inner_->width(); }
  int height() const override { return inner_->height(); }
  bool is_static() const override { return inner_->is_static(); }

  Status capture(Nanoseconds deadline, StereoFrame& frame) override {
    for (;;) {
      if (plan_->feel(FaultKind::camera_gone, clock_->now()) != nullptr) return Status::disconnected;
      const Status status = inner_->capture(deadline, frame);
      if (status != Status::ok) return status;
      const Nanoseconds now = clock_->now();
      if (plan_->feel(FaultKind::camera_gone, now) != nullptr) return Status::disconnected;
      if (plan_->feel(FaultKind::camera_torn, now) != nullptr) return Status::bad_data;
      if (plan_->feel(FaultKind::camera_silent, now) != nullptr) continue;
      spoil(now, frame);
      return Status::ok;
    }
  }

 private:
  void spoil(Nanoseconds now, StereoFrame& frame) {
    if (plan_->feel(FaultKind::camera_skewed, now) != nullptr) frame.right_time -= skew_;
    if (const Fault* fault = plan_->feel(FaultKind::camera_dark, now)) blind(fault->eyes, dark_, frame);
    if (const Fault* fault = plan_->feel(FaultKind::camera_bright, now)) blind(fault->eyes, bright_, frame);
    if (const Fault* fault = plan_->active(FaultKind::camera_frozen, now)) freeze(fault->number, now, frame);
  }

  static void blind(Eyes eyes, const Image<std::uint8_t>& image, StereoFrame& frame) {
    if (eyes != Eyes::right) frame.left = image.view();
    if (eyes != Eyes::left) frame.right = image.view();
  }

  // The first pair of the fault is the one that stays.
  void freeze(std::uint64_t fault, Nanoseconds now, StereoFrame& frame) {
    if (fault != frozen_in_) {
      frozen_in_ = fault;
      copy(frame.left, frozen_left_.view());
      copy(frame.right, frozen_right_.view());
      return;
    }
    (void)plan_->feel(FaultKind::camera_frozen, now);
    frame.left = frozen_left_.view();
    frame.right = frozen_right_.view();
  }

  std::unique_ptr<StereoCamera> inner_;
  const Nanoseconds skew_;
  FaultPlan* plan_;
  Clock* clock_;
  Image<std::uint8_t> dark_, bright_, frozen_left_, frozen_right_;
  std::uint64_t frozen_in_ = 0;  // number of the fault
};

// Where the wheels have turned the vehicle to.
class WheelHeading final : public HeadingProducer {
 public:
  WheelHeading(FaultyServo& servo, double track_m) : servo_(&servo), track_m_(track_m) {}

  Status heading(Nanoseconds /*time*/, HeadingSample& sample) override {
    const WheelTravel travel = servo_->true_travel();
    sample = {.yaw = wrapped_angle((travel.right_m - travel.left_m) / track_m_)};
    return Status::ok;
  }

 private:
  FaultyServo* servo_;
  const double track_m_;
};

class FaultyCompass final : public Compass {
 public:
  FaultyCompass(std::unique_ptr<Compass> inner, double tilt_deg, FaultPlan& plan, Clock& clock)
      : inner_(std::move(inner)), tilt_((tilt_deg + 10) * kRadiansPerDegree), plan_(&plan), clock_(&clock) {}

  Status open() override { return inner_->open(); }
  void close() override { inner_->close(); }
  std::span<const Counter> counters() const override { return inner_->counters(); }

  Status read(Nanoseconds deadline, HeadingSample& sample) override {
    const Nanoseconds now = clock_->now();
    if (plan_->feel(FaultKind::compass_gone, now) != nullptr) return Status::disconnected;
    if (plan_->feel(FaultKind::compass_silent, now) != nullptr) return Status::timeout;
    const Status status = inner_->read(deadline, sample);
    if (status != Status::ok) return status;
    if (plan_->feel(FaultKind::compass_jumped, now) != nullptr)
      sample.yaw = wrapped_angle(sample.yaw + 90 * kRadiansPerDegree);
    if (plan_->feel(FaultKind::compass_tipped, now) != nullptr) sample.roll = tilt_;
    return status;
  }

 private:
  std::unique_ptr<Compass> inner_;
  const double tilt_;
  FaultPlan* plan_;
  Clock* clock_;
};

class FaultyEstop final : public EmergencyStop {
 public:
  FaultyEstop(FaultPlan& plan, const Clock& clock) : plan_(&plan), clock_(&clock) {}

  Status open() override { return Status::ok; }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }

  Status read(bool& pressed) override {
    pressed = plan_->feel(FaultKind::emergency_stop, clock_->now()) != nullptr;
    return Status::ok;
  }

 private:
  FaultPlan* plan_;
  const Clock* clock_;
};

// What a driver talks through, and goes after it.
struct Recording {
  RecordedFolder folder;
  KeptPairs pairs;
  explicit Recording(const FolderConfig& config) : folder(config), pairs(folder, kMostKeptBytes) {}
};

}  // namespace

KeptPairs::KeptPairs(RecordedPairs& recording, std::size_t most_bytes) {
  const auto pixels = static_cast<std::size_t>(recording.width()) * static_cast<std::size_t>(recording.height());
  const auto fit =
      std::clamp<std::size_t>(most_bytes / (2 * pixels), 1, static_cast<std::size_t>(recording.count()));
  for (int n = 0; n < static_cast<int>(fit); ++n) {
    left_.emplace_back(recording.width(), recording.height());
    right_.emplace_back(recording.width(), recording.height());
    if (recording.load(n, left_.back().view(), right_.back().view()) != Status::ok)
      throw InputError("recording",
                       "pair " + std::to_string(n) + " cannot be read, or has another size than the first");
  }
}

Status KeptPairs::load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) {
  copy(left_[static_cast<std::size_t>(n)].view(), left);
  copy(right_[static_cast<std::size_t>(n)].view(), right);
  return Status::ok;
}

Status FaultyServo::exchange(Nanoseconds deadline) {
  const Nanoseconds now = clock_->now();
  Status status = Status::ok;
  if (plan_->feel(FaultKind::drive_silent, now) != nullptr) status = Status::timeout;
  if (plan_->feel(FaultKind::drive_refused, now) != nullptr) status = Status::refused;
  if (plan_->feel(FaultKind::drive_garbled, now) != nullptr) status = Status::bad_data;
  if (plan_->feel(FaultKind::drive_gone, now) != nullptr) status = Status::disconnected;
  if (status == Status::ok) return status;
  (void)inner_->stop(deadline);
  if (status == Status::timeout) clock_->sleep_until(deadline);
  return status;
}

Status FaultyServo::drive(const WheelVelocities& wanted, Nanoseconds deadline) {
  told_to_turn_ = wanted.left_mps != 0 || wanted.right_mps != 0;
  const Status status = exchange(deadline);
  return status == Status::ok ? inner_->drive(wanted, deadline) : status;
}

Status FaultyServo::stop(Nanoseconds deadline) {
  told_to_turn_ = false;
  const Status status = exchange(deadline);
  return status == Status::ok ? inner_->stop(deadline) : status;
}

Status FaultyServo::read_travel(Nanoseconds deadline, WheelTravel& travel) {
  const Status status = exchange(deadline);
  return status == Status::ok ? inner_->read_travel(deadline, travel) : status;
}

WheelTravel FaultyServo::true_travel() {
  WheelTravel travel;
  (void)inner_->read_travel(clock_->now(), travel);
  return travel;
}

double FaultyServo::way_m() {
  const WheelTravel travel = true_travel();
  way_m_ += (std::abs(travel.left_m - seen_.left_m) + std::abs(travel.right_m - seen_.right_m)) / 2;
  seen_ = travel;
  return way_m_;
}

SoakVehicle make_soak_vehicle(const VehicleConfig& config, FaultPlan& plan, Clock& clock) {
  SoakVehicle vehicle;
  auto recording = std::make_shared<Recording>(config.folder);
  vehicle.pairs = recording->pairs.count();
  const FolderCameraSettings pace{.pace = Pace::rate, .rate_hz = config.folder.rate_hz, .repeat = true};
  auto camera = std::make_unique<FolderCamera>(pace, recording->pairs, clock);
  vehicle.devices.camera = {recording,
                            std::make_unique<FaultyCamera>(std::move(camera), config.safety, plan, clock)};

  Made<Servo> servo = make_servo(config, clock);
  auto faulty = std::make_unique<FaultyServo>(std::move(servo.device), plan, clock);
  vehicle.servo = faulty.get();
  vehicle.devices.servo = {std::move(servo.below), std::move(faulty)};

  auto heading = std::make_shared<WheelHeading>(*vehicle.servo, config.vehicle.track_m);
  auto compass = std::make_unique<SimCompass>(config.compass.rate_hz, *heading, clock);
  vehicle.devices.compass = {
      heading, std::make_unique<FaultyCompass>(std::move(compass), config.safety.tilt_deg, plan, clock)};
  vehicle.devices.estop = {nullptr, std::make_unique<FaultyEstop>(plan, clock)};
  return vehicle;
}

}  // namespace lakshya
