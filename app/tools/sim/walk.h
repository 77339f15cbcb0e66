// Where somebody who walks to and fro is at a time.
#pragma once

#include "app/tools/sim/world.h"

namespace lakshya::sim {

// Along the points and back the same way, for ever, at an even speed, facing where he goes. A way without length: he stands on
// its first point, yaw 0. Before time 0 he walked too.
Place place_on_walk(const Walk& walk, double time_s);

}  // namespace lakshya::sim
