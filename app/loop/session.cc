#include "app/loop/session.h"

#include <omp.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <utility>

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
  Secretary(Machinery& machinery, Recorder& recorder, RunRecord& record, std::string latch)
      : m_(&machinery),
        x_(&machinery.exchange()),
        recorder_(&recorder),
        record_(&record),
        line_(isatty(STDERR_FILENO) != 0, record.start),
        latch_(std::move(latch)),
        is_latched_(!latch_.empty() && machinery.exchange().fault_before.load()) {}

  void keep_house() {
    StateNote note;
    while (x_->notes.pop(note)) {
      line_.log(note);
      state_ = note.to;
      if (record_->notes.size() < RunRecord::kMostNotes) {
        record_->notes.push_back(note);
      } else {
        ++record_->notes_left_out;
      }
    }
    Decision decision;
    while (x_->decisions.pop(decision))
      (void)recorder_->write(decision, record_->start);
    if (x_->map.take()) draw(x_->map.reading().type, x_->map.reading().plan);
    keep_latch();
    if (recorder_->has_failed() && !told_failure_) {
      spdlog::error("recording: {}", recorder_->problem());
      told_failure_ = true;
      x_->recording_failed.store(true);
    }
    if (x_->status.take()) line_.show(x_->status.reading());
    record_->end = x_->status.reading().time;
  }

  // A person has looked: there may be room again.
  void try_again() {
    recorder_->try_again();
    told_failure_ = false;
    x_->recording_failed.store(false);
  }

  // On the virtual clock every map can be drawn; on the machine's, those that are there when there is time.
  void on_frame(const FrameResult& frame, const PlanNote& plan) override {
    const MemoryWatch not_the_loops(WatchedPlace::nowhere);
    draw(frame.map, plan);
  }

 private:
  // While the vehicle is in FAULT there is a file, so that a crash does not end what only a person may end.
  void keep_latch() {
    if (latch_.empty()) return;
    const bool latched = state_ == State::fault;
    if (latched == is_latched_) return;
    is_latched_ = latched;
    std::error_code ignored;
    if (!latched) {
      std::filesystem::remove(latch_, ignored);
      return;
    }
    try {
      write_file_atomically(latch_, "FAULT\n");
    } catch (const InputError& e) {
      spdlog::error("{}", e.what());
    }
  }

  void draw(ImageView<const std::uint8_t> type, const PlanNote& plan) {
    if (recorder_->wants_picture(plan.number)) (void)recorder_->write_map(type, plan, m_->config());
  }

  Machinery* m_;
  Exchange* x_;
  Recorder* recorder_;
  RunRecord* record_;
  StatusLine line_;
  bool told_failure_ = false;
  const std::string latch_;
  bool is_latched_;
  State state_ = State::init;
};

std::unique_ptr<Recorder> make_recorder(Machinery& m, const SessionOptions& o) {
  auto recorder = std::make_unique<Recorder>(o.out, o.picture_every, !o.virtual_clock);
  m.exchange().records.store(recorder->is_on());
  return recorder;
}

void run_on_virtual_clock(Machinery& m, SteppedClock& clock, const SessionOptions& o, RunRecord& record) {
  const std::unique_ptr<Recorder> recorder = make_recorder(m, o);
  Secretary secretary(m, *recorder, record, o.latch);
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

void run_on_machine_clock(Machinery& m, Clock& clock, const SessionOptions& o, RunRecord& record) {
  const std::unique_ptr<SystemdWatchdog> systemd = open_systemd();
  const Made<Watchdog> machine = make_watchdog(m.config(), clock);
  if (machine.device != nullptr && machine.device->open() != Status::ok)
    throw InputError("drivers.watchdog: " + m.config().drivers.watchdog, machine.device->problem());
  const std::unique_ptr<Recorder> recorder = make_recorder(m, o);
  Secretary secretary(m, *recorder, record, o.latch);
  m.perception().copy_maps(recorder->is_on());
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
  hooks.before_reset = [&] { secretary.try_again(); };
  hooks.housekeeping = [&] {
    secretary.keep_house();
    const StatusNote& status = m.exchange().status.reading();
    if (systemd == nullptr || status.turns == 0 || status.state == told) return;
    if (told == State::end) (void)systemd->ready();
    told = status.state;
    (void)systemd->say(to_string(told));
  };
  run_threaded(m, clock, o.limits, hooks);
  secretary.keep_house();
  if (systemd != nullptr) systemd->close();
  if (machine.device != nullptr) machine.device->close();
  if (recorder->is_on()) spdlog::info("recorded in {}: decisions.jsonl and map_*.png", recorder->folder());
}

// Hours later is too late to find out.
void require_writable(const std::string& report) {
  if (report.empty()) return;
  std::error_code error;
  const std::string probe = report + ".probe";
  write_file_atomically(probe, "");
  std::filesystem::remove(probe, error);
}

}  // namespace

void run_session(const VehicleConfig& config, const SessionOptions& o, const KernelTable& kernels) {
  if (config.loop.threads > 0) omp_set_num_threads(config.loop.threads);
  MonotonicClock machine_clock;
  SteppedClock virtual_clock;
  Clock& clock = o.virtual_clock ? static_cast<Clock&>(virtual_clock) : machine_clock;
  const StereoCalibration calibration = loop_calibration(config, o.config_path);
  Machinery machinery(config, calibration, make_devices(config, clock), kernels, clock, machine_clock);
  std::error_code ignored;
  if (!o.out.empty()) std::filesystem::create_directories(o.out, ignored);  // where the report may be, too
  require_writable(o.report);
  machinery.exchange().fault_before.store(!o.latch.empty() && std::filesystem::exists(o.latch, ignored));

  RunRecord record;
  record.source = o.source;
  record.virtual_clock = o.virtual_clock;
  record.start = record.end = clock.now();
  const Nanoseconds began = machine_clock.now();
  if (o.virtual_clock) {
    run_on_virtual_clock(machinery, virtual_clock, o, record);
  } else {
    run_on_machine_clock(machinery, machine_clock, o, record);
  }
  record.wall_s = static_cast<double>(machine_clock.now() - began) / 1e9;

  const nlohmann::ordered_json report = run_report(machinery, machinery.exchange(), record);
  std::cout << (o.json ? report.dump() + "\n" : report_text(report)) << std::flush;
  if (!o.report.empty()) write_file_atomically(o.report, report.dump(2) + "\n");
}

}  // namespace lakshya
