// The firmware's main loop in its threads, on emulated devices that can be made to fail at any moment: two QuickSilver drives and
// an OS5000 on pseudo-terminals with their real drivers, a camera in memory, an emergency stop in a file.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/core/devices.h"
#include "app/loop/machinery.h"
#include "app/loop/threaded_run.h"
#include "hal/clock/monotonic_clock.h"
#include "hal/estop.h"
#include "tests/emulators/on_terminal.h"
#include "tests/emulators/os5000_device.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/temp_folder.h"

namespace lakshya::test {

inline constexpr int kRigWidth = 320;
inline constexpr int kRigHeight = 240;

// f = 200 px, B = 0.12 m, camera 0.6 m above a floor that reaches to the horizon.
inline StereoCalibration rig_calibration() {
  StereoCalibration c;
  c.source = "rig";
  c.width = kRigWidth;
  c.height = kRigHeight;
  c.left = {.fx = 200, .fy = 200, .cx = 160, .cy = 120};
  c.right = c.left;
  c.T = {-0.12, 0, 0};
  c.images_rectified = true;
  return c;
}

// Twenty pairs a second of a textured floor that moves; each differs from the one before.
class RigCamera final : public StereoCamera {
 public:
  enum class Fault : std::uint8_t { none, silent, gone, frozen, half_frozen, dark, bright, skewed, torn };

  explicit RigCamera(Clock& clock) : clock_(&clock) {}

  Status open() override {
    pixels_.assign(std::size_t{2} * kRigWidth * kRigHeight, 0);
    next_ = clock_->now();
    return Status::ok;
  }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }
  int width() const override { return kRigWidth; }
  int height() const override { return kRigHeight; }

  Status capture(Nanoseconds deadline, StereoFrame& frame) override {
    const Fault now = fault;
    if (now == Fault::gone) return Status::disconnected;
    if (now == Fault::silent || next_ > deadline) {
      clock_->sleep_until(deadline);
      return Status::timeout;
    }
    clock_->sleep_until(next_);
    if (fault == Fault::silent) return Status::timeout;
    const Nanoseconds time = clock_->now();
    next_ = std::max(next_ + kPeriod, time);
    if (now == Fault::torn) return Status::bad_data;
    if (now != Fault::frozen) draw(now);
    const ImageView<const std::uint8_t> left(pixels_.data(), kRigWidth, kRigHeight);
    const ImageView<const std::uint8_t> right(left.row(kRigHeight), kRigWidth, kRigHeight);
    frame = {left, right, time, now == Fault::skewed ? time - 30 * kMillisecond : time, ++number_};
    return Status::ok;
  }

  std::atomic<Fault> fault = Fault::none;

 private:
  static constexpr Nanoseconds kPeriod = 50 * kMillisecond;

  static std::uint8_t texture(std::uint32_t u, std::uint32_t v) {
    std::uint32_t x = u * 2654435761U + v * 40503U + 12345U;
    x = (x ^ (x >> 15)) * 2246822519U;
    return static_cast<std::uint8_t>(x >> 24);
  }

  void draw(Fault now) {
    ++step_;
    for (int v = 0; v < kRigHeight; ++v) {
      const int disparity = std::max((v - kRigHeight / 2) * 12 / 60, 1);  // (B/H) (v - c_v)
      for (int u = 0; u < kRigWidth; ++u) {
        const auto x = static_cast<std::uint32_t>(u + 64);
        const auto y = static_cast<std::uint32_t>(v + step_);
        std::uint8_t left = texture(x, y);
        std::uint8_t right = texture(x + static_cast<std::uint32_t>(disparity), y);
        if (now == Fault::dark) left = right = static_cast<std::uint8_t>(left & 3);
        if (now == Fault::bright) left = 255;
        pixels_[static_cast<std::size_t>(v * kRigWidth + u)] = left;
        if (now != Fault::half_frozen) pixels_[static_cast<std::size_t>((kRigHeight + v) * kRigWidth + u)] = right;
      }
    }
  }

  Clock* clock_;
  Nanoseconds next_ = 0;
  int step_ = 0;
  std::uint64_t number_ = 0;
  std::vector<std::uint8_t> pixels_;
};

// Its own switch, and a way to hold up the control loop.
class RigEstop final : public EmergencyStop {
 public:
  Status open() override { return Status::ok; }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }
  Status read(bool& is_pressed) override {
    const int ms = stall_ms.exchange(0);
    if (ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    is_pressed = pressed;
    return unreadable ? Status::disconnected : Status::ok;
  }

  std::atomic<bool> pressed = false;
  std::atomic<bool> unreadable = false;
  std::atomic<int> stall_ms = 0;
};

// What the kernel table's score does besides.
inline std::atomic<bool> rig_perception_stalls = false;
inline std::atomic<bool> rig_perception_fails = false;
inline std::atomic<bool> rig_perception_is_stalled = false;
inline Status rig_score(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm,
                        const NavGrid& grid) {
  while (rig_perception_stalls) {
    rig_perception_is_stalled = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  rig_perception_is_stalled = false;
  return rig_perception_fails ? Status::bad_argument : score_simd(thresholds, min_height_mm, grid);
}
inline KernelTable rig_kernels() {
  KernelTable kernels = kSimdKernels;
  kernels.score = rig_score;
  return kernels;
}

struct LoopRig {
  explicit LoopRig(const std::function<void(VehicleConfig&)>& change = {}) {
    {
      const auto lock = compass_terminal.locked();
      compass.rate_hz = 20;
    }
    VehicleConfig config;
    config.drivers.servo = "quicksilver";
    config.drivers.compass = "os5000";
    config.quicksilver.port = drive_terminal.path();
    config.os5000.port = compass_terminal.path();
    config.compass.rate_hz = 20;
    config.camera.height_m = 0.6;
    config.matcher.disparities = 32;
    config.vehicle.max_speed_mps = 0.8;
    config.safety.recover_s = 0.3;
    config.loop.threads = 1;
    if (change) change(config);
    VehicleDevices devices;
    devices.servo = make_servo(config, clock);
    devices.compass = make_compass(config, clock);
    auto made_camera = std::make_unique<RigCamera>(clock);
    camera = made_camera.get();
    devices.camera.device = std::move(made_camera);
    auto made_estop = std::make_unique<RigEstop>();
    estop = made_estop.get();
    devices.estop.device = std::move(made_estop);
    machinery = std::make_unique<Machinery>(config, rig_calibration(), std::move(devices), kernels, clock, clock);
  }
  ~LoopRig() { end(); }
  LoopRig(const LoopRig&) = delete;
  LoopRig& operator=(const LoopRig&) = delete;

  void start() {
    hooks.housekeeping = [this] {
      if (machinery->exchange().status.take()) {
        state = machinery->exchange().status.reading().state;
        reason = machinery->exchange().status.reading().reason;
      }
      StateNote note;
      while (machinery->exchange().notes.pop(note))
        notes.push_back(note);
      Decision decision;
      while (machinery->exchange().decisions.pop(decision)) {
      }
    };
    runner = std::thread([this] { run_threaded(*machinery, clock, {}, hooks); });
  }

  void end() {
    rig_perception_stalls = false;
    rig_perception_fails = false;
    machinery->exchange().terminate = true;
    if (runner.joinable()) runner.join();
  }

  // Both drives have been told to stand, or their resident programs have seen to it.
  bool stands() {
    const auto lock = drive_terminal.locked();
    for (std::size_t i = 0; i < drives.drives(); ++i) {
      const emulator::QuickSilverState s = drives.state(i, emulator::monotonic_ns());
      // A velocity of 1 is the driver's trial of the resident program.
      if (std::abs(drives.drive(i).value(30)) > 1 && !s.tripped) return false;
    }
    return true;
  }

  // Milliseconds until `what` is so; -1: not within the time.
  template <class What>
  double milliseconds_until(What what, int limit_ms) {
    const Nanoseconds begin = clock.now();
    while (!what()) {
      if (clock.now() - begin > limit_ms * kMillisecond) return -1;
      clock.sleep_until(clock.now() + kMillisecond / 2);
    }
    return static_cast<double>(clock.now() - begin) / 1e6;
  }

  bool drives_again(int limit_ms = 5000) {
    return milliseconds_until([this] { return state == State::run && !stands(); }, limit_ms) >= 0;
  }

  MonotonicClock clock;
  emulator::QuickSilverLine drives;
  emulator::OnTerminal drive_terminal{drives};
  emulator::Os5000Device compass;
  emulator::OnTerminal compass_terminal{compass};
  KernelTable kernels = rig_kernels();
  RigCamera* camera = nullptr;
  RigEstop* estop = nullptr;
  ThreadedHooks hooks;
  std::unique_ptr<Machinery> machinery;
  std::vector<StateNote> notes;  // the runner's, until end()
  std::atomic<State> state = State::init;
  std::atomic<Event> reason = Event::all_well;
  std::thread runner;
};

}  // namespace lakshya::test
