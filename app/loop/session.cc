#include "app/loop/session.h"

#include <omp.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <iostream>

#include "app/core/devices.h"
#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/loop/machinery.h"
#include "app/loop/memory_watch.h"
#include "app/loop/real_time.h"
#include "app/loop/recorder.h"
#include "app/loop/run_report.h"
#include "app/loop/status_line.h"
#include "app/loop/threaded_run.h"
#include "hal/clock/monotonic_clock.h"
#include "hal/watchdog/systemd_watchdog.h"

namespace lakshya {
namespace {

// What the caller's thread does beside the loop: it shows and writes what the others tell.
class Secretary final : public FrameSink {
 public:
  Secretary(Machinery& machinery, Recorder& recorder, RunRecord& record)
      : m_(&machinery),
        x_(&machinery.exchange()),
        recorder_(&recorder),
        record_(&record),
        line_(isatty(STDERR_FILENO) != 0, record.start) {}

  void keep_house() {
    StateNote note;
    while (x_->notes.pop(note)) {
      line_.log(note);
      if (record_->notes.size() < RunRecord::kMostNotes) {
        record_->notes.push_back(note);
      } else {
        ++record_->notes_left_out;
      }
    }
    Decision decision;
    while (x_->decisions.pop(decision))
      (void)recorder_->write(decision, record_->start);
    if (x_->map.take() && recorder_->wants_picture(x_->map.reading().plan.number)) draw(x_->map.reading());
    if (recorder_->has_failed() && !told_failure_) {
      spdlog::error("recording: {}", recorder_->problem());
      told_failure_ = true;
      x_->recording_failed.store(true);
    }
    if (x_->status.take()) line_.show(x_->status.reading());
    record_->end = x_->status.reading().time;
  }

  // On the virtual clock every map can be drawn; on the machine's, those that are there when there is time.
  void on_frame(const FrameResult& frame, const PlanNote& plan) override {
    const MemoryWatch not_the_loops(WatchedPlace::nowhere);
    if (recorder_->wants_picture(plan.number)) (void)recorder_->write_map(frame.grid.type, plan, m_->config());
  }

 private:
  void draw(const MapNote& map) { (void)recorder_->write_map(map.type, map.plan, m_->config()); }

  Machinery* m_;
  Exchange* x_;
  Recorder* recorder_;
  RunRecord* record_;
  StatusLine line_;
  bool told_failure_ = false;
};

void run_on_virtual_clock(Machinery& m, SteppedClock& clock, const SessionOptions& o, Recorder& recorder,
                          RunRecord& record) {
  Secretary secretary(m, recorder, record);
  m.perception().show(&secretary);
  run_stepped(m, clock, o.limits, [&] { secretary.keep_house(); });
  secretary.keep_house();
}

// systemd, where it has started this program.
std::unique_ptr<SystemdWatchdog> open_systemd() {
  auto systemd = std::make_unique<SystemdWatchdog>(systemd_watchdog_settings());
  if (systemd->open() != Status::ok) return nullptr;
  return systemd;
}

void run_on_machine_clock(Machinery& m, Clock& clock, const SessionOptions& o, Recorder& recorder,
                          RunRecord& record) {
  Secretary secretary(m, recorder, record);
  m.perception().copy_maps(recorder.is_on());
  const std::unique_ptr<SystemdWatchdog> systemd = open_systemd();
  const Made<Watchdog> machine = make_watchdog(m.config(), clock);
  if (machine.device != nullptr && machine.device->open() != Status::ok)
    throw InputError("drivers.watchdog: " + m.config().drivers.watchdog, machine.device->problem());
  ThreadedHooks hooks;
  if (systemd != nullptr) hooks.watchdogs.push_back(systemd.get());
  if (machine.device != nullptr) hooks.watchdogs.push_back(machine.device.get());
  const std::string not_locked = lock_memory();
  if (!not_locked.empty()) {
    spdlog::warn(
        "memory is not locked ({}): control turns may come late when memory is short (run as a service, or with "
        "CAP_IPC_LOCK or LimitMEMLOCK)",
        not_locked);
  }
  State told = State::end;
  hooks.housekeeping = [&] {
    secretary.keep_house();
    const State state = m.exchange().status.reading().state;
    if (systemd == nullptr || state == told) return;
    if (told == State::end) (void)systemd->ready();
    told = state;
    (void)systemd->say(to_string(state));
  };
  run_threaded(m, clock, o.limits, hooks);
  secretary.keep_house();
  if (systemd != nullptr) systemd->close();
  if (machine.device != nullptr) machine.device->close();
}

}  // namespace

void run_session(const VehicleConfig& config, const SessionOptions& o, const KernelTable& kernels) {
  if (config.loop.threads > 0) omp_set_num_threads(config.loop.threads);
  MonotonicClock machine_clock;
  SteppedClock virtual_clock;
  Clock& clock = o.virtual_clock ? static_cast<Clock&>(virtual_clock) : machine_clock;
  const StereoCalibration calibration = loop_calibration(config, o.config_path);
  Machinery machinery(config, calibration, make_devices(config, clock), kernels, clock, machine_clock);
  Recorder recorder(o.out, o.picture_every);

  RunRecord record;
  record.source = o.source;
  record.virtual_clock = o.virtual_clock;
  record.start = record.end = clock.now();
  const Nanoseconds began = machine_clock.now();
  if (o.virtual_clock) {
    run_on_virtual_clock(machinery, virtual_clock, o, recorder, record);
  } else {
    run_on_machine_clock(machinery, machine_clock, o, recorder, record);
  }
  record.wall_s = static_cast<double>(machine_clock.now() - began) / 1e9;

  const nlohmann::ordered_json report = run_report(machinery, machinery.exchange(), record);
  if (!o.report.empty()) write_file_atomically(o.report, report.dump(2) + "\n");
  if (o.json) {
    std::cout << report.dump() << '\n';
  } else {
    std::cout << report_text(report);
    if (recorder.is_on()) std::cout << "results: " << recorder.folder() << "/decisions.jsonl and map_*.png\n";
  }
}

}  // namespace lakshya
