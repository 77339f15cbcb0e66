// What stands in rooms and outdoors: one maker per kind. Lengths in metres; a thing's own origin is the middle of its foot, its
// length lies along its own x axis. `Spot` says where, how it is turned and how high above z = 0 its foot is.
//
// A maker sets kind, name (= kind; the caller makes names unique), what to expect of it, and surfaces with the contrast that such
// things have: a painted wall or a lacquered table top shows little. Shapes are exact: no maker rounds a size.
#pragma once

#include <cstdint>

#include "app/tools/sim/mesh_builder.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

// What hangs with its lower edge at this height or above may be driven under.
inline constexpr double kClearanceM = 1.2;
inline constexpr double kCeilingM = 2.5;
inline constexpr double kRobotRadiusM = 0.35;

// All sides the same surface.
void paint(Thing& thing, const Surface& surface);

Thing box(const Spot& spot, double length, double width, double height);
Thing crate(const Spot& spot, double length, double width, double height);  // of wood
Thing wall(const Spot& spot, double length, double thickness, double height);
Thing pole(const Spot& spot, double diameter, double height);
Thing floor_lamp(const Spot& spot, double height);  // foot, thin pole, shade
Thing column(const Spot& spot, double diameter, double height);

Thing chair(const Spot& spot, double seat_height);                          // legs of 3.5 cm, the back at -x
Thing table(const Spot& spot, double length, double width, double height);  // legs of 4.5 cm, a top of 3 cm
// A body and, above it, a board that sticks out towards +x.
Thing shelf(const Spot& spot, double length, double height, double board_height, double overhang);
Thing bench(const Spot& spot, double length);  // two feet set in, a seat of 0.45 m that sticks out

// Hang from cords of 1 cm that end at the ceiling; `spot.bottom_m` is the lower edge. Free from kClearanceM on.
Thing hanging_bar(const Spot& spot, double length, double thickness);
Thing hanging_lamp(const Spot& spot, double diameter);

Thing newspaper(const Spot& spot, double length, double width);  // 4..8 mm high, driven over
Thing person(const Spot& spot, double height);                   // faces its own +x
Thing walking_person(const Walk& walk, double height, std::uint32_t seed);

Thing bush(const Spot& spot, double diameter, double height);
Thing rock(const Spot& spot, double diameter, double height);
Thing tree(const Spot& spot, double trunk_diameter, double height);  // its crown begins above the clearance
Thing hedge(const Spot& spot, double length, double thickness, double height);
Thing fence(const Spot& spot, double length, double height);

// A wall with an opening of 2 m height in its middle; `length` is the whole.
Thing doorway(const Spot& spot, double length, double opening, double height);
// Over a room: without it one looks at the sky.
Thing ceiling(const Spot& spot, double length, double width);
// Seen through; only its frame above 2 m is not.
Thing glass_pane(const Spot& spot, double length, double height);

}  // namespace lakshya::sim
