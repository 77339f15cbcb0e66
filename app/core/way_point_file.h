// Way points from a text file, a line each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/nav/way_point.h"

namespace lakshya {

// The first line says what the two numbers of every other line are:
//   east_m,north_m                in the world frame, metres from the start
//   latitude_deg,longitude_deg    WGS 84; the first such line is where the vehicle starts, and no way point
// Empty lines and those that begin with # are skipped. 1 to 10000 way points, none farther than 100 km. Throws InputError with
// the line for anything else.
std::vector<WayPoint> read_way_points(const std::string& path);

// The same for a file's content; `source` stands for the path in messages.
std::vector<WayPoint> parse_way_points(std::string_view text, const std::string& source);

}  // namespace lakshya
