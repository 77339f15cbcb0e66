#include "app/tools/soak_checker.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace lakshya {
namespace {

double seconds(Nanoseconds t) {
  return static_cast<double>(t) / static_cast<double>(kSecond);
}

}  // namespace

std::string violation_text(const SoakViolation& v, Nanoseconds start) {
  const std::string when =
      fmt::format("{:.3f} s, {}, state {}: ", seconds(v.now - start), to_string(v.kind), to_string(v.state));
  const double since = seconds(v.now - v.since);
  switch (v.rule) {
    case SoakRule::stops_in_time:
      return when + fmt::format("the wheels are told to turn {:.3f} s after it began", since);
    case SoakRule::recovers:
      return when + fmt::format("not in RUN {:.3f} s after it ended", since);
    case SoakRule::waits_for_reset:
      return when + fmt::format("the vehicle drives {:.3f} s after it latched, before any reset", since);
  }
  return when;
}

SoakChecker::SoakChecker(const SoakLimits& limits, Nanoseconds start) : limits_(limits), well_since_(start) {
  violations_.reserve(kMostKept);
}

void SoakChecker::violate(const SoakViolation& violation) {
  ++violation_count_;
  if (violations_.size() < kMostKept) violations_.push_back(violation);
}

void SoakChecker::begin(const Fault& fault, Track& track) {
  track.has_begun = true;
  if (fault.kind != FaultKind::camera_frozen) {
    track.counts_from = fault.begin;
    track.turning = told_to_turn_;
  }
  ++faults_;
  ++record(fault.kind).times;
  if (told_to_turn_) ++record(fault.kind).while_turning;
}

void SoakChecker::watch(const Fault& fault, Track& track, const SoakTurn& turn) {
  if (fault.kind == FaultKind::camera_frozen) {
    if (fault.felt < 0) return;
    if (track.way_when_felt < 0) {
      track.way_when_felt = turn.way_m;
      track.turning = told_to_turn_;
    }
    const bool has_moved = turn.way_m - track.way_when_felt >= limits_.frozen_travel_m;
    if (track.counts_from < 0 && has_moved) track.counts_from = turn.now;
  }
  const bool counts = track.counts_from >= 0;
  const Nanoseconds since = counts ? turn.now - track.counts_from : 0;
  if (!turn.told_to_turn) {
    if (track.turning) track.reaction = since;
  } else if (counts && since > limits_.reaction && !track.told_late) {
    track.told_late = true;
    violate({SoakRule::stops_in_time, turn.now, track.counts_from, fault.kind, turn.state});
  }
  track.turning = turn.told_to_turn;
}

void SoakChecker::finish(const Fault& fault, const Track& track) {
  well_since_ = std::max(well_since_, fault.end);
  ended_ = fault.kind;
  has_begun_ = true;
  told_recovery_ = false;
  if (track.reaction < 0 || track.turning) return;
  ++record(fault.kind).stopped;
  record(fault.kind).worst_reaction = std::max(record(fault.kind).worst_reaction, track.reaction);
}

void SoakChecker::check_latch(const SoakTurn& turn) {
  if (!latched_ || told_latch_ || (!turn.told_to_turn && !may_drive(turn.state))) return;
  told_latch_ = true;
  violate({SoakRule::waits_for_reset, turn.now, latched_at_, latch_kind_, turn.state});
}

void SoakChecker::check_recovery(const SoakTurn& turn) {
  if (turn.state != State::run) has_left_run_ = true;
  if (any_fault_ || latched_) return;
  const Nanoseconds since = turn.now - well_since_;
  if (turn.state == State::run) {
    if (has_left_run_ && has_begun_) {
      ++record(ended_).recovered;
      record(ended_).worst_recovery = std::max(record(ended_).worst_recovery, since);
    }
    has_left_run_ = false;
  } else if (since > limits_.recovery && !told_recovery_) {
    told_recovery_ = true;
    violate({SoakRule::recovers, turn.now, well_since_, ended_, turn.state});
  }
}

void SoakChecker::turn(const SoakTurn& turn) {
  any_fault_ = false;
  for (std::size_t i = 0; i < turn.faults.size() && i < tracks_.size(); ++i) {
    const Fault& fault = turn.faults[i];
    Track& track = tracks_[i];
    if (track.number != fault.number) track = {.number = fault.number};
    if (turn.now < fault.begin || track.is_over) continue;
    if (!track.has_begun) begin(fault, track);
    if (latches(fault.kind) && fault.felt >= 0 && !latched_) {
      latched_ = true;
      told_latch_ = false;
      latched_at_ = fault.felt;
      latch_kind_ = fault.kind;
    }
    if (turn.now < fault.end) {
      any_fault_ = true;
      watch(fault, track, turn);
    } else {
      track.is_over = true;
      finish(fault, track);
    }
  }
  check_latch(turn);
  check_recovery(turn);
  told_to_turn_ = turn.told_to_turn;
}

void SoakChecker::reset(Nanoseconds now) {
  latched_ = false;
  well_since_ = std::max(well_since_, now);
}

}  // namespace lakshya
