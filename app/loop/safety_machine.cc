#include "app/loop/safety_machine.h"

namespace lakshya {
namespace {

constexpr Kind kWorstFirst[] = {Kind::latches, Kind::stops, Kind::slows};

void keep_since(bool well, Nanoseconds now, Nanoseconds& since) {
  if (!well) {
    since = -1;
  } else if (since < 0) {
    since = now;
  }
}

}  // namespace

void SafetyMachine::note(Event event, State from, Nanoseconds now) {
  if (noted_ < notes_.size()) notes_[noted_++] = {now, event, from, state_};
}

void SafetyMachine::apply(Event event, Nanoseconds now, bool is_new) {
  const State from = state_;
  const Transition t = transition(from, event);
  state_ = t.next;
  // Several events may come in one step: zero is not taken back by a later one that changes nothing.
  if (from != t.next || action_ != Action::zero_now) action_ = t.action;
  // Before everything has been heard of for the first time, something is always missing; and at the end of a recording.
  const bool is_news = is_new && kind_of(event) != Kind::course && from != State::init && from != State::end;
  if (from != t.next || is_news) note(event, from, now);
  if (kind_of(event) == Kind::course) {
    if (from != t.next) reason_ = event == Event::terminate ? event : Event::all_well;
  } else if (from != t.next || (is_new && from != State::end && kind_of(event) > kind_of(reason_))) {
    reason_ = event;  // a smaller or a later fault is not why the vehicle stands
  }
}

// Where the reason has gone, the worst that lasts is the reason. A fault that is latched, and what is waited for to be well
// again for long enough, stay the reason.
void SafetyMachine::renew_reason(const EventSet& faults) {
  const bool lasts = faults.has(reason_);
  if (lasts || state_ == State::fault || state_ == State::end) return;
  for (const Kind kind : kWorstFirst) {
    for (std::size_t i = 0; i < kEvents; ++i) {
      const auto event = static_cast<Event>(i);
      if (kind_of(event) != kind || !faults.has(event)) continue;
      if (kind >= kind_of(reason_) || state_ != State::stop) reason_ = event;
      return;
    }
  }
  if (state_ == State::ready || state_ == State::run) reason_ = Event::all_well;
}

Action SafetyMachine::step(Nanoseconds now, const Conditions& c) {
  noted_ = 0;
  const bool goes_on = may_drive(state_) || state_ == State::end;
  action_ = goes_on ? transition(state_, Event::go).action : Action::hold_zero;
  if (c.terminate) apply(Event::terminate, now, false);
  // A reset comes first, so that what is still wrong latches again in the same step.
  const State before_reset = state_;
  if (c.reset) apply(Event::reset, now, false);
  // Whoever resets gets away before the wheels turn: what was well in FAULT does not count.
  if (state_ != before_reset) well_since_ = -1;
  for (const Kind kind : kWorstFirst) {
    for (std::size_t i = 0; i < kEvents; ++i) {
      const auto event = static_cast<Event>(i);
      if (kind_of(event) == kind && c.faults.has(event)) apply(event, now, !before_.has(event));
    }
  }
  before_ = c.faults;
  const bool stops = c.faults.any(Kind::stops) || c.faults.any(Kind::latches);
  keep_since(!stops, now, well_since_);
  keep_since(c.faults.empty(), now, whole_since_);
  if (state_ == State::end) return action_;
  proceed(now, c);
  renew_reason(c.faults);
  return action_;
}

void SafetyMachine::proceed(Nanoseconds now, const Conditions& c) {
  const Nanoseconds since = state_ == State::degraded ? whole_since_ : well_since_;
  const bool waits = state_ == State::init || state_ == State::stop || state_ == State::degraded;
  if (waits && since >= 0 && now - since >= recover_) apply(Event::all_well, now, false);
  if (!c.has_goal && may_drive(state_)) apply(Event::arrived, now, false);
  if (c.has_goal && state_ == State::ready) {
    apply(Event::go, now, false);
    for (const Event event : {Event::camera_damaged, Event::recording_lost, Event::watchdog_failed}) {
      if (c.faults.has(event)) apply(event, now, false);
    }
  }
}

}  // namespace lakshya
