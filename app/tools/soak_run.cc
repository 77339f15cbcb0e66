#include "app/tools/soak_run.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/core/recorded_folder.h"
#include "app/loop/machinery.h"
#include "app/loop/memory_watch.h"
#include "app/loop/real_time.h"
#include "app/loop/stepped_run.h"
#include "app/tools/soak_devices.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

constexpr std::uint64_t kSamples = 100;
constexpr Nanoseconds kBeforeFirstFault = 2 * kSecond;

Nanoseconds nanoseconds(double seconds) {
  return std::llround(seconds * static_cast<double>(kSecond));
}

std::uint64_t open_handles() {
  std::uint64_t count = 0;
  for ([[maybe_unused]] const auto& handle : std::filesystem::directory_iterator("/proc/self/fd"))
    ++count;
  return count - 1;  // the one that looks
}

std::uint64_t loop_allocations() {
  return allocations_at(WatchedPlace::loop) + allocations_at(WatchedPlace::decoding);
}

// The time that perception took for each frame of a window. Is called in the loop's own scope: it must not allocate.
class FrameTimer final : public FrameSink {
 public:
  explicit FrameTimer(std::uint64_t window) { times_.reserve(window + 64); }

  void on_frame(const FrameResult& /*frame*/, const PlanNote& plan) override {
    if (times_.size() < times_.capacity()) times_.push_back(plan.took);
  }
  void read(SoakSample& sample) {
    std::ranges::sort(times_);
    if (!times_.empty()) {
      sample.p50 = times_[times_.size() / 2];
      sample.p99 = times_[times_.size() * 99 / 100];
    }
    times_.clear();
  }

 private:
  std::vector<Nanoseconds> times_;
};

class Soak {
 public:
  Soak(Machinery& machinery, FaultyServo& servo, FaultPlan& plan, Clock& clock, SoakResult& result)
      : m_(&machinery),
        servo_(&servo),
        plan_(&plan),
        clock_(&clock),
        result_(&result),
        checker_(result.limits, result.start),
        window_(std::max<std::uint64_t>(result.settings.frames / kSamples, 1)),
        timer_(window_) {
    result.samples.reserve(2 * kSamples);
    m_->perception().show(&timer_);
  }
  ~Soak() { m_->perception().show(nullptr); }
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  void after_turn() {
    const Nanoseconds now = clock_->now();
    const State state = m_->control().state();
    forget_notes();
    if (state != State::end) {
      checker_.turn({now, state, servo_->is_told_to_turn(), servo_->way_m(), plan_->faults()});
      if (plan_->step(now)) {
        m_->exchange().reset.store(true);
        checker_.reset(now);
      }
    }
    // Counting begins again when the loop is READY for the first time in this process.
    if (!was_armed_ && memory_watch_armed()) allocations_before_ = 0;
    was_armed_ = memory_watch_armed();
    result_->frames = m_->perception().frames();
    if (result_->frames >= next_sample_) sample(now);
  }

  void finish() {
    result_->turns = m_->control().counts().turns;
    result_->virtual_time = clock_->now() - result_->start;
    result_->records = checker_.records();
    result_->faults = checker_.faults();
    result_->violations = checker_.violations();
    result_->first_violations = checker_.first_violations();
    result_->allocations_are_counted = allocations_are_counted();
  }

 private:
  // Nobody reads them here.
  void forget_notes() {
    Exchange& x = m_->exchange();
    StateNote note;
    while (x.notes.pop(note)) {
    }
    Decision decision;
    while (x.decisions.pop(decision)) {
    }
    (void)x.status.take();
  }

  void sample(Nanoseconds now) {
    SoakSample s;
    s.frames = result_->frames;
    s.time = now - result_->start;
    s.faults = checker_.faults() - faults_before_;
    s.resident_bytes = resident_bytes();
    s.handles = open_handles();
    timer_.read(s);
    s.allocations = loop_allocations() - allocations_before_;
    allocations_before_ = loop_allocations();
    faults_before_ = checker_.faults();
    next_sample_ = result_->frames + window_;
    result_->samples.push_back(s);
  }

  Machinery* m_;
  FaultyServo* servo_;
  FaultPlan* plan_;
  Clock* clock_;
  SoakResult* result_;
  SoakChecker checker_;
  const std::uint64_t window_;
  FrameTimer timer_;
  std::uint64_t next_sample_ = window_;
  std::uint64_t faults_before_ = 0;
  std::uint64_t allocations_before_ = loop_allocations();
  bool was_armed_ = memory_watch_armed();
};

}  // namespace

VehicleConfig soak_config(VehicleConfig config) {
  config.drivers = {.camera = "folder",
                    .servo = "record",
                    .compass = "sim",
                    .unsupervised_speed_mps = config.drivers.unsupervised_speed_mps};
  config.folder.pace = "rate";
  config.folder.repeat = "yes";
  config.record.path.clear();
  config.mission.way_points.clear();
  config.map.rolling = "no";  // the pictures do not go where the wheels do
  return config;
}

SoakResult run_soak(const VehicleConfig& config, const SoakSettings& settings, const KernelTable& kernels,
                    const std::function<void(const SoakResult&)>& progress) {
  if (config.loop.threads > 0) omp_set_num_threads(config.loop.threads);
  SteppedClock clock;
  const MonotonicClock machine_clock;
  SoakResult result;
  result.settings = settings;
  result.start = clock.now();
  result.limits.recovery = nanoseconds(config.safety.recover_s) + kSecond;
  result.limits.frozen_travel_m = config.safety.frozen_travel_m;

  const StereoCalibration calibration = loop_calibration(config, settings.config_path);
  const FaultSettings faults{.seed = settings.seed,
                             .recovery = result.limits.recovery,
                             .longest_jump = nanoseconds(0.9 * config.odometry.jump_hold_s),
                             .can_freeze = RecordedFolder(config.folder).count() > 1};
  FaultPlan plan(faults, result.start + kBeforeFirstFault);
  SoakVehicle vehicle = make_soak_vehicle(config, plan, clock);
  FaultyServo& servo = *vehicle.servo;
  result.pairs = vehicle.pairs;
  Machinery machinery(config, calibration, std::move(vehicle.devices), kernels, clock, machine_clock);
  result.width = machinery.devices().camera.device->width();
  result.height = machinery.devices().camera.device->height();

  const Nanoseconds began = machine_clock.now();
  Soak soak(machinery, servo, plan, clock, result);
  run_stepped(machinery, clock, {.frames = settings.frames}, [&] {
    soak.after_turn();
    if (progress) progress(result);
  });
  soak.finish();
  result.wall_s = static_cast<double>(machine_clock.now() - began) / 1e9;
  return result;
}

}  // namespace lakshya
