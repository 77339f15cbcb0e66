#include "hal/servo/quicksilver_travel.h"

#include <cmath>

#include "hal/servo/quicksilver_protocol.h"

namespace lakshya {
namespace {

constexpr double kSpeedMargin = 1.5;
constexpr double kDistanceMargin = 0.05;  // m

}  // namespace

void QuickSilverTravel::start(double metres_per_count, double max_speed_mps) {
  *this = {};
  metres_per_count_ = metres_per_count;
  max_speed_mps_ = max_speed_mps;
}

bool QuickSilverTravel::is_near(const Reading& before, const Reading& now) const {
  if (!before.exists) return false;
  const auto counts = static_cast<double>(quicksilver::counts_between(before.position, now.position));
  const double seconds = static_cast<double>(now.time - before.time) / kSecond;
  return std::abs(counts * metres_per_count_) <= kSpeedMargin * max_speed_mps_ * seconds + kDistanceMargin;
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
