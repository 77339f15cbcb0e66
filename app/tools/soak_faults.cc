#include "app/tools/soak_faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lakshya {
namespace {

enum class Victim : std::uint8_t { camera, compass, drives, estop };

struct KindFacts {
  FaultKind kind;
  const char* name;
  Victim victim;
  bool latches;
};

using enum FaultKind;
constexpr std::array<KindFacts, kFaultKinds> kFacts{{
    {camera_silent, "camera silent", Victim::camera, false},
    {camera_gone, "camera gone", Victim::camera, false},
    {camera_frozen, "camera frozen", Victim::camera, false},
    {camera_dark, "camera dark", Victim::camera, false},
    {camera_bright, "camera bright", Victim::camera, false},
    {camera_skewed, "camera skewed", Victim::camera, false},
    {camera_torn, "camera torn", Victim::camera, false},
    {compass_silent, "compass silent", Victim::compass, false},
    {compass_gone, "compass gone", Victim::compass, false},
    {compass_jumped, "compass jumped", Victim::compass, false},
    {compass_tipped, "compass tipped", Victim::compass, true},
    {drive_silent, "drive silent", Victim::drives, false},
    {drive_refused, "drive refused", Victim::drives, false},
    {drive_garbled, "drive garbled", Victim::drives, false},
    {drive_gone, "drive gone", Victim::drives, false},
    {emergency_stop, "emergency stop", Victim::estop, true},
}};

constexpr bool facts_are_in_order() {
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    if (static_cast<std::size_t>(kFacts[i].kind) != i) return false;
  }
  return true;
}
static_assert(facts_are_in_order());

const KindFacts& facts(FaultKind kind) {
  return kFacts[static_cast<std::size_t>(kind)];
}

constexpr Nanoseconds kShortest = 50 * kMillisecond;
constexpr Nanoseconds kLongest = 3 * kSecond;
constexpr double kTwoAtOnce = 0.15;   // share of the times
constexpr double kShortPause = 0.25;  // the same

}  // namespace

const char* to_string(FaultKind kind) {
  return facts(kind).name;
}

bool latches(FaultKind kind) {
  return facts(kind).latches;
}

FaultPlan::FaultPlan(const FaultSettings& settings, Nanoseconds start)
    : settings_(settings), random_(settings.seed) {
  for (std::size_t i = 0; i < kFaultKinds; ++i)
    deck_[i] = static_cast<FaultKind>(i);
  draw_next(start + settings_.recovery);
}

// The standard's distributions differ from library to library.
double FaultPlan::share() {
  return static_cast<double>(random_() >> 11U) * 0x1p-53;
}

Nanoseconds FaultPlan::between(Nanoseconds least, Nanoseconds most) {
  return least + std::llround(share() * static_cast<double>(most - least));
}

FaultKind FaultPlan::draw_kind() {
  for (;;) {
    if (next_ == kFaultKinds) {
      for (std::size_t i = kFaultKinds - 1; i > 0; --i)
        std::swap(deck_[i], deck_[static_cast<std::size_t>(share() * static_cast<double>(i + 1))]);
      next_ = 0;
    }
    const FaultKind kind = deck_[next_++];
    if (kind != camera_frozen || settings_.can_freeze) return kind;
  }
}

FaultKind FaultPlan::draw_kind_beside(FaultKind other) {
  for (;;) {
    const FaultKind kind = draw_kind();
    if (facts(kind).victim != facts(other).victim) return kind;
  }
}

// Short ones as often as long ones: the logarithm of the duration is even.
Fault FaultPlan::draw_fault(FaultKind kind, Nanoseconds begin) {
  const double ratio = static_cast<double>(kLongest) / static_cast<double>(kShortest);
  Nanoseconds duration = std::llround(static_cast<double>(kShortest) * std::pow(ratio, share()));
  if (kind == compass_jumped) duration = std::min(duration, settings_.longest_jump);
  const auto eyes = static_cast<Eyes>(share() * 3);
  return {.kind = kind, .number = ++numbers_, .begin = begin, .end = begin + duration, .eyes = eyes};
}

void FaultPlan::draw_next(Nanoseconds after) {
  const bool is_short = share() < kShortPause;
  const Nanoseconds pause =
      is_short ? between(0, kSecond / 2) : settings_.recovery + between(kSecond / 5, 2 * kSecond);
  const bool two = share() < kTwoAtOnce;
  faults_[0] = draw_fault(draw_kind(), after + pause);
  count_ = 1;
  if (two) {
    const FaultKind kind = draw_kind_beside(faults_[0].kind);
    faults_[1] = draw_fault(kind, between(faults_[0].begin, faults_[0].end));
    count_ = 2;
  }
  reset_pause_ = between(kSecond / 5, kSecond);
}

bool FaultPlan::step(Nanoseconds now) {
  Nanoseconds over = 0;
  bool latched = false;
  for (const Fault& fault : faults()) {
    over = std::max(over, fault.end);
    latched = latched || (latches(fault.kind) && fault.felt >= 0);
  }
  if (now < (latched ? over + reset_pause_ : over)) return false;
  draw_next(now);
  return latched;
}

const Fault* FaultPlan::active(FaultKind kind, Nanoseconds now) const {
  for (const Fault& fault : faults()) {
    if (fault.kind == kind && fault.begin <= now && now < fault.end) return &fault;
  }
  return nullptr;
}

const Fault* FaultPlan::feel(FaultKind kind, Nanoseconds now) {
  for (Fault& fault : std::span(faults_.data(), count_)) {
    if (fault.kind != kind || now < fault.begin || fault.end <= now) continue;
    if (fault.felt < 0) fault.felt = now;
    return &fault;
  }
  return nullptr;
}

}  // namespace lakshya
