// Where somebody is who walks to and fro.
#pragma once

#include "app/tools/sim/world.h"

namespace lakshya::sim {

// On the way there and back, `start_m` + speed x time along it, facing the direction of motion. A walk of length 0 stays at its
// first point and faces east.
Place place_on_walk(const Walk& walk, double time_s);

}  // namespace lakshya::sim
