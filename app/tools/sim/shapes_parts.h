// Private to the makers of shapes.
#pragma once

#include "app/tools/sim/shapes.h"

namespace lakshya::sim {

Thing made(const char* kind, const MeshBuilder& builder, const Spot& spot, Expect expect);

}  // namespace lakshya::sim
