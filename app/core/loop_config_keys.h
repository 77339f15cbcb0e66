// The part of the list of keys (vehicle_config_keys.h) that is about the main loop.
#pragma once

#include <array>
#include <string_view>

#include "app/core/config_key.h"

namespace lakshya {

inline constexpr std::array<std::string_view, 2> kStopGo{"stop", "go"};

template <class Memory, class Visitor>
void visit_memory_keys(Memory& c, Visitor& v) {
  v(Key{"memory.limit_mb", "MB", "Most that the main loop's memory may take; more is refused at the start"},
    c.limit_mb, Range{1, 65536, 1});
}

template <class Mission, class Visitor>
void visit_mission_keys(Mission& c, Visitor& v) {
  v(Key{"mission.way_points", "",
        "File of way points (README, \"Way points\"); empty: always in the direction direction_deg"},
    c.way_points, Text{});
  v(Key{"mission.arrival_m", "m", "A way point that is nearer than this is reached"}, c.arrival_m,
    Range{0.05, 100});
  v(Key{"mission.direction_deg", "deg", "Without way points: where to go, to the left of straight ahead"},
    c.direction_deg, Range{-180, 180});
}

template <class Loop, class Visitor>
void visit_loop_keys(Loop& c, Visitor& v) {
  v(Key{"loop.threads", "", "Threads of the image processing; 0: one for each processor"}, c.threads,
    Range{0, 256, 1});
  v(Key{"loop.virtual_latency_s", "s", "On the virtual clock (replay): from the capture of a pair to its plan"},
    c.virtual_latency_s, Range{0, 2});
  v(Key{"loop.recovery_turn_dps", "deg/s",
        "Turn on the spot towards the more open side where no direction is open; 0: stand still"},
    c.recovery_turn_dps, Range{0, 180});
}

template <class Safety, class Visitor>
void visit_safety_keys(Safety& c, Visitor& v) {
  v(Key{"safety.camera_silent_s", "s", "Stop when no pair has come for so long"}, c.camera_silent_s,
    Range{0.02, 10});
  v(Key{"safety.compass_silent_s", "s", "Stop when no heading has come for so long"}, c.compass_silent_s,
    Range{0.02, 10});
  v(Key{"safety.perception_s", "s", "Stop when one pair has been worked on for so long"}, c.perception_s,
    Range{0.01, 10});
  v(Key{"safety.plan_age_s", "s", "Stop when the plan was made of a pair older than this"}, c.plan_age_s,
    Range{0.02, 10});
  v(Key{"safety.control_late_s", "s", "Stop when the control loop began a turn so late"}, c.control_late_s,
    Range{0.001, 10});
  v(Key{"safety.skew_s", "s", "Stop when the two images of a pair were taken further apart"}, c.skew_s,
    Range{0, 1});
  v(Key{"safety.frozen_pairs", "",
        "Stop when so many pairs in a row are the same, byte for byte, while the wheels turn"},
    c.frozen_pairs, Range{2, 100, 1});
  v(Key{"safety.frozen_travel_m", "m", "How far the wheels must have gone meanwhile"}, c.frozen_travel_m,
    Range{0, 1});
  v(Key{"safety.dark_level", "", "A pixel of at most this brightness is black"}, c.dark_level, Range{0, 255, 1});
  v(Key{"safety.dark_share", "", "Stop when so large a part of either image is black"}, c.dark_share,
    Range{0.01, 1});
  v(Key{"safety.bright_level", "", "A pixel of at least this brightness is saturated"}, c.bright_level,
    Range{0, 255, 1});
  v(Key{"safety.bright_share", "", "Stop when so large a part of either image is saturated"}, c.bright_share,
    Range{0.01, 1});
  v(Key{"safety.tilt_deg", "deg", "Stop, until reset, when the compass feels a pitch or roll greater than this"},
    c.tilt_deg, Range{5, 90});
  v(Key{"safety.recover_s", "s", "After a stop that ends by itself: how long everything must have been well"},
    c.recover_s, Range{0, 60});
  v(Key{"safety.degraded_speed_mps", "m/s", "Greatest speed in the state DEGRADED"}, c.degraded_speed_mps,
    Range{0, 5});
  v(Key{"safety.recording_failed", "",
        "A recording that can no longer be written (stop: until reset; go: on, DEGRADED, without it)"},
    c.recording_failed, Names{kStopGo});
}

template <class Config, class Visitor>
void visit_main_loop_keys(Config& c, Visitor& v) {
  visit_mission_keys(c.mission, v);
  visit_loop_keys(c.loop, v);
  visit_safety_keys(c.safety, v);
  visit_memory_keys(c.memory, v);
}

}  // namespace lakshya
