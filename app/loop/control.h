// The third thread's work, 50 times a second: where are we, is all well, what are the wheels told?
//
// One turn: read the emergency stop and what the compass, capture, perception and driving have handed over; step through the table
// of states (safety_table.h); hand over what the wheels shall do. It waits for nobody.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "app/core/stage_times.h"
#include "app/core/vehicle_config.h"
#include "app/loop/messages.h"
#include "app/loop/safety_machine.h"
#include "app/nav/steering.h"
#include "app/nav/way_point.h"
#include "hal/clock.h"
#include "hal/estop.h"
#include "hal/odometry/wheel_odometry.h"

namespace lakshya {

inline constexpr Nanoseconds kControlPeriod = 20 * kMillisecond;

// When the turn after the one of `due` is due. Turns that are over already at `now` are left out; they were counted as late.
inline Nanoseconds next_turn(Nanoseconds due, Nanoseconds now) {
  due += kControlPeriod;
  return now > due + kControlPeriod ? due + (now - due) / kControlPeriod * kControlPeriod : due;
}

struct ControlDevices {
  double max_speed_mps = 0;  // the drives'
  bool has_compass = false;
  EmergencyStop* estop = nullptr;  // null: none
};

// What there is to say when all is over.
struct ControlCounts {
  std::uint64_t turns = 0;
  std::uint64_t overruns = 0;  // turns that were left out: the one before came late, or took too long
  std::array<Nanoseconds, kStates> in_state{};
  std::array<std::uint64_t, kEvents> faults{};  // how often each began
  TimeHistogram lateness;                       // of a turn's beginning
  TimeHistogram took;
};

class Control {
 public:
  // The devices are open and outlive it, as do clock and exchange.
  Control(const VehicleConfig& config, std::vector<WayPoint> way_points, const ControlDevices& devices,
          Clock& clock, Exchange& exchange);

  // The turn that was due at `due`. False: it was the last one, the wheels have got their last zero.
  bool turn(Nanoseconds due);

  // From a test or a report, when no turn is running.
  State state() const { return machine_.state(); }
  const ControlCounts& counts() const { return counts_; }
  std::uint64_t plans() const { return plans_; }

 private:
  void take_headings(Nanoseconds now);
  void read_estop();
  void take_frame(Nanoseconds now);
  bool take_plan();
  void judge_camera(Nanoseconds now);
  void judge_plan(Nanoseconds now);
  Conditions judge(Nanoseconds now, Nanoseconds due);
  void count_faults();
  bool find_goal();
  WheelVelocities wanted(Action action) const;
  void take_drive(Nanoseconds now);
  void command(Action action, Nanoseconds now);
  bool has_ended() const;
  void tell(Nanoseconds now);
  void write_down(const PlanNote& plan, Nanoseconds now);
  double direction_now() const;

  const VehicleConfig config_;
  const std::vector<WayPoint> way_points_;
  const ControlDevices devices_;
  Clock* clock_;
  Exchange* exchange_;
  SafetyMachine machine_;
  WheelOdometry odometry_;
  EventSet faults_;
  EventSet counted_;                  // those of the turn before
  std::uint64_t lost_decisions_ = 0;  // at the last reset
  PoseSample pose_;
  PoseHistory history_;
  std::size_t way_point_ = 0;
  double target_ = 0;
  double target_m_ = std::numeric_limits<double>::infinity();
  bool has_goal_ = false;

  std::optional<Nanoseconds> last_turn_;

  FrameNote frame_;
  std::uint64_t damaged_ = 0;     // of frame_, when it was last looked at
  double same_since_m_ = 0;       // travel when the pairs began to be the same
  std::optional<PlanNote> plan_;  // the newest that is one
  PlanNote newest_plan_;
  std::optional<Nanoseconds> waiting_since_;  // a pair, for perception
  std::uint64_t plans_ = 0;
  std::optional<Nanoseconds> heading_time_;
  DriveNote drive_;
  std::uint64_t commands_ = 0;
  bool last_command_stops_ = true;
  std::uint64_t end_command_ = 0;  // the first one in the state END
  std::uint64_t end_turns_ = 0;
  double way_m_ = 0;        // both wheels' way, without sign
  WheelVelocities wheels_;  // as last commanded
  ControlCounts counts_;
};

}  // namespace lakshya
