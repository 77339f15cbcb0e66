#include "app/nav/speed_governor.h"

#include <algorithm>
#include <cmath>

namespace lakshya {

double governed_speed(double clear_m, const GovernorParams& p) {
  if (std::isinf(clear_m) && clear_m > 0) return p.max_speed_mps;
  const double braking_m = clear_m - p.stop_margin_m;
  if (!(braking_m > 0)) return 0;
  const double stoppable =
      2 * braking_m / (p.latency_s + std::sqrt(p.latency_s * p.latency_s + 2 * braking_m / p.deceleration_mps2));
  const double in_time = p.contact_time_s > 0 ? clear_m / p.contact_time_s : p.max_speed_mps;
  return std::min({stoppable, in_time, p.max_speed_mps});
}

}  // namespace lakshya
