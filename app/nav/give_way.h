// How fast the vehicle may go, and whether it may turn, where something moves: docs/contract.md section 5.
//
// The vehicle's next seconds are followed step by step at several speeds, with its latency, its acceleration and its turn towards the
// direction, against where the movers will be: on with their velocity or, because who walks may turn round, back the way
// they came for a shorter time. Who is out of view may be farther off his way the longer he is. The highest speed at which nobody comes
// nearer to its side than kGiveWayMarginM is allowed. Where somebody
// comes so near even to a vehicle that stands it must stand, and not turn either: whoever moves cannot
// tell a turn from a start.
#pragma once

#include <span>

#include "app/nav/mover.h"
#include "app/nav/params.h"
#include "app/nav/planner.h"

namespace lakshya {

struct Intention {
  double now_mps = 0;    // as fast as the vehicle is
  double speed_mps = 0;  // as fast as it would go
  double direction = 0;  // rad, from straight ahead
  bool hurries = false;  // has waited so long that only those count whom it sees, going on as they do
};

// Who walks to and fro before the vehicle must not hold it for ever.
struct Patience {
  static constexpr int kWaits = 60;    // plans that give way in a row
  static constexpr int kHurries = 30;  // plans after that
  int waited = 0;
  int hurries = 0;
};

struct GiveWay {
  double speed_mps = 0;  // at most the intended one
  bool stands = false;   // no turn on the spot either
};

inline constexpr double kMoverRadiusM = 0.30;
inline constexpr double kGiveWayMarginM = 0.20;  // between the vehicle's side and a mover's

// The movers at the time of `pose`. All finite; vehicle.deceleration_mps2 > 0.
GiveWay give_way(const VehicleParams& vehicle, std::span<const Mover> movers, const Pose& pose,
                 const Intention& intention);

// The plan so limited; one without a way turns on the spot, and gives way, too. now_mps: as fast as the vehicle is.
void limit_plan(const VehicleParams& vehicle, std::span<const Mover> movers, const Pose& pose, double now_mps,
                Patience& patience, Plan& plan);

}  // namespace lakshya
