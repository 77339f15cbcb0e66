// What the threads of the main loop tell each other. Each goes through a hand-over that never waits (triple_buffer.h, ring.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "app/loop/pose_history.h"
#include "app/loop/ring.h"
#include "app/loop/safety_machine.h"
#include "app/loop/triple_buffer.h"
#include "app/nav/planner.h"
#include "hal/camera.h"
#include "hal/compass.h"
#include "hal/odometry.h"
#include "hal/servo.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

// Capture to control: what came of the last capture.
struct FrameNote {
  Status status = Status::timeout;
  std::uint64_t count = 0;    // pairs captured so far, this one included
  Nanoseconds arrived = 0;    // the last pair that came
  Nanoseconds taken = 0;      // its time of capture, of the eye that is older
  Nanoseconds skew = 0;       // between its two eyes
  double dark = 0;            // share of black pixels, of the eye that has more
  double bright = 0;          // the same of saturated ones
  int same = 0;               // how many images before it in a row were just the same, of the eye that has more
  std::uint64_t damaged = 0;  // captures that gave a pair nobody can use, so far
  bool over = false;          // the recording has ended
};

// Capture to perception: a raw pair, in the loop's memory.
struct RawPair {
  ImageView<std::uint8_t> left;
  ImageView<std::uint8_t> right;
  std::uint64_t number = 0;  // counted from 1
  Nanoseconds taken = 0;
  Nanoseconds arrived = 0;
};

// Sensing to control.
struct HeadingNote {
  Status status = Status::timeout;
  HeadingSample sample;
};

// Control to perception: where the vehicle is and wants to go.
struct NavNote {
  PoseSample pose;
  double target = 0;  // rad, from straight ahead of that pose
  PoseHistory history;
  double target_m = std::numeric_limits<double>::infinity();  // how far it is
};

// Perception to control: what a pair gave.
struct PlanNote {
  Status status = Status::timeout;
  std::uint64_t number = 0;  // of the pair
  Nanoseconds taken = 0;
  Nanoseconds arrived = 0;
  Nanoseconds started = 0;
  Nanoseconds done = 0;  // on the virtual clock: when control may know of it
  Nanoseconds took = 0;  // the pipeline, on the machine's clock
  PoseSample pose;       // that it was planned from
  double target = 0;     // and where to
  bool blocked = true;
  Side recovery = Side::left;
  bool hemmed_in = false;  // blocked, and turning round has not helped
  bool yields = false;     // stands, and does not turn either, because of somebody who moves
  double direction = 0;    // rad, from straight ahead of that pose
  double clear_m = 0;
  ClearEnd clear_end = ClearEnd::unknown;
  double speed_mps = 0;
  double ground_pitch_deg = 0;
  double nearest_m = -1;        // nearest obstacle cell of the map; -1: none
  std::uint32_t obstacles = 0;  // cells
};

// Control to driving: what the wheels shall do.
struct DriveCommand {
  WheelVelocities wheels;
  bool stops = true;         // as fast as the drives can; `wheels` are zero
  Nanoseconds time = 0;      // of the control turn
  std::uint64_t number = 0;  // counted from 1
};

// Driving to control: how the last exchange with the drives went.
struct DriveNote {
  std::uint64_t number = 0;  // of the command
  Status command_status = Status::timeout;
  Status travel_status = Status::timeout;  // of the newest reading
  WheelTravel travel;                      // the last one that could be read
  Nanoseconds time = 0;                    // when the command was over
};

// Control to whoever shows and records: one for every plan that control has taken up.
struct Decision {
  PlanNote plan;
  Nanoseconds time = 0;  // of the control turn
  State state = State::init;
  Event reason = Event::all_well;
  PoseSample pose;
  WheelVelocities wheels;
};

// Control to whoever shows: the newest turn.
struct StatusNote {
  Nanoseconds time = 0;
  std::uint64_t turns = 0;
  State state = State::init;
  Event reason = Event::all_well;
  PoseSample pose;
  WheelVelocities wheels;
  bool blocked = true;   // the plan found no way
  double direction = 0;  // rad, the plan's as seen from the vehicle now
  double clear_m = 0;
  double nearest_m = -1;
  Nanoseconds plan_age = 0;
  Nanoseconds frame_time = 0;  // perception's, of that plan
  std::uint64_t frames = 0;    // pairs captured
  std::size_t way_point = 0;   // the next one
};

// Perception to whoever draws: the map's cells in the loop's memory.
struct MapNote {
  ImageView<std::uint8_t> type;
  PlanNote plan;
};

struct Exchange {
  TripleBuffer<RawPair> raw;
  TripleBuffer<FrameNote> frame;
  TripleBuffer<NavNote> nav;
  TripleBuffer<DriveCommand> drive_command;
  TripleBuffer<DriveNote> drive;
  TripleBuffer<StatusNote> status;
  TripleBuffer<MapNote> map;
  Ring<PlanNote, 64> plans;
  Ring<HeadingNote, 64> headings;
  Ring<Decision, 256> decisions;
  Ring<StateNote, 256> notes;

  std::atomic<std::uint64_t> dropped = 0;      // pairs that perception never looked at
  std::atomic<Nanoseconds> working_since = 0;  // perception, on one pair; 0: it waits
  std::atomic<std::uint64_t> looked_at = 0;    // number of the newest pair that perception has begun
  std::atomic<bool> drive_is_urgent = false;   // the newest command is a stop
  std::atomic<bool> terminate = false;
  std::atomic<bool> reset = false;
  std::atomic<bool> fault_before = false;  // until the first reset
  std::atomic<bool> records = false;       // somebody writes the decisions down
  std::atomic<bool> recording_failed = false;
  std::atomic<bool> watchdog_failed = false;
  std::atomic<bool> ended = false;  // control: the wheels have got their last zero
};

}  // namespace lakshya
