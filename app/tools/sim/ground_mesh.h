// The ground as triangles.
#pragma once

#include "app/tools/sim/mesh.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

// The ground's rectangle cut at all edges of patches; every cell lies in its patch's plane (the uppermost in the list; else
// z = 0), and where two neighbours do not meet a wall closes the gap, so nothing can be seen through. Surface 0 is the plain
// ground's, i + 1 patch i's; a wall has that of the later patch beside it. Parts of patches outside the rectangle are left out.
Mesh ground_mesh(const Ground& ground);

}  // namespace lakshya::sim
