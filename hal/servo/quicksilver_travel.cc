#include "hal/servo/quicksilver_travel.h"

#include <algorithm>
#include <cmath>

#include "hal/servo/quicksilver_protocol.h"

namespace lakshya {
namespace {

constexpr double kSpeedMargin = 1.5;
constexpr double kDistanceMargin = 0.05;  // m

}  // namespace

void QuickSilverTravel::start(double metres_per_count, double max_speed_mps, Nanoseconds longest_pause) {
  *this = {};
  longest_pause_ = longest_pause;
  metres_per_count_ = metres_per_count;
  max_speed_mps_ = max_speed_mps;
}

void QuickSilverTravel::rebase() {
  last_ = {};
  doubted_ = {};
}

bool QuickSilverTravel::is_near(const Reading& before, const Reading& now) const {
  if (!before.exists) return false;
  const auto counts = static_cast<double>(quicksilver::counts_between(before.position, now.position));
  const double seconds = static_cast<double>(std::min(now.time - before.time, longest_pause_)) / kSecond;
  return std::abs(counts * metres_per_count_) <= kSpeedMargin * max_speed_mps_ * seconds + kDistanceMargin;
}

bool QuickSilverTravel::is_where_it_was(std::int32_t position) const {
  return last_.exists && is_near(last_, {.exists = true, .position = position, .time = last_.time});
}

QuickSilverTravel::Verdict QuickSilverTravel::take(std::int32_t position, Nanoseconds time) {
  const Reading reading{.exists = true, .position = position, .time = time};
  const bool believed = !last_.exists || is_near(last_, reading);
  const bool restarted = !believed && is_near(doubted_, reading);
  if (!believed && !restarted) {
    doubted_ = reading;
    return Verdict::doubted;
  }
  const Reading& before = restarted ? doubted_ : last_;
  if (before.exists) counts_ += quicksilver::counts_between(before.position, position);
  last_ = reading;
  doubted_ = {};
  return restarted ? Verdict::restarted : Verdict::believed;
}

}  // namespace lakshya
