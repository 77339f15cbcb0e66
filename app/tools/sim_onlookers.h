// Who looks on at a simulated drive.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "app/loop/status_line.h"
#include "app/tools/sim/run_world.h"

namespace lakshya {

// Passes every call on to each, in their order.
class Onlookers final : public sim::Onlooker {
 public:
  // They outlive it.
  explicit Onlookers(std::vector<sim::Onlooker*> all) : all_(std::move(all)) {}

  void on_start(sim::Simulation& simulation, const Machinery& machinery) override {
    for (sim::Onlooker* one : all_)
      one->on_start(simulation, machinery);
  }
  void on_frame(const FrameResult& frame, const PlanNote& plan, const sim::Shot& shot) override {
    for (sim::Onlooker* one : all_)
      one->on_frame(frame, plan, shot);
  }
  void on_turn(const StatusNote& status, const sim::VehicleState& vehicle) override {
    for (sim::Onlooker* one : all_)
      one->on_turn(status, vehicle);
  }
  void on_state(const StateNote& note) override {
    for (sim::Onlooker* one : all_)
      one->on_state(note);
  }

 private:
  std::vector<sim::Onlooker*> all_;
};

// What is going on, for people, on stderr: one line that is written over on a terminal, elsewhere one every few seconds of the
// drive; every change of state once.
class SimStatus final : public sim::Onlooker {
 public:
  // `live`: stderr is a terminal.
  explicit SimStatus(bool live) : live_(live) {}

  void on_turn(const StatusNote& status, const sim::VehicleState& /*vehicle*/) override {
    line(status.time).show(status);
  }
  void on_state(const StateNote& note) override { line(note.time).log(note); }

 private:
  // Times are counted from the first call on.
  StatusLine& line(Nanoseconds time) { return line_ ? *line_ : line_.emplace(live_, time); }

  const bool live_;
  std::optional<StatusLine> line_;
};

}  // namespace lakshya
