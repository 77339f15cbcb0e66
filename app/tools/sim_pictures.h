// Pictures of simulated drives, for people.
#pragma once

#include <string>

#include "app/core/image.h"
#include "app/tools/sim/run_result.h"
#include "app/tools/sim/world.h"

namespace lakshya {

// The world from above with the way that the vehicle took, coloured by speed; 1200 px wide. The longer side of the course lies
// across: north is up or to the right, as an arrow shows. The shown part is where the vehicle was, with some metres around. A
// result without a trace (or with one point) shows the world alone.
Image<Rgb8> course_picture(const sim::World& world, const sim::RunResult& result, double vehicle_radius_m);

// "random-indoor", or the name of a world's file without folders and ending; only letters, digits, '.', '-' and '_', never empty.
std::string world_label(const std::string& world);

// "reached", "collision with table 3 (person not in view)"
std::string ending_text(const sim::RunResult& result);

}  // namespace lakshya
