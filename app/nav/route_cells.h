// What route*.cc share, for nobody else.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "app/nav/route.h"

namespace lakshya {

inline constexpr std::int32_t kRouteFar =
    std::numeric_limits<std::int32_t>::max();  // cost of a cell that no way leads to
inline constexpr int kRouteReach = 9;          // cells that distances to obstacles are known up to
inline constexpr std::uint8_t kRouteShut =
    0x80;  // bit of a type: closed, and passed through only to find out which to doubt
inline constexpr std::uint8_t kRouteCame = 0x40;  // ... an obstacle where the ground was free before
inline constexpr double kRouteNear = 5;           // cells from which on the target counts as reached
inline constexpr int kRouteClosed = 0;            // factor of a cell that is none of the way
inline constexpr int kRouteOpen = 10;             // ... of a free cell, tenths
inline constexpr int kRouteStraight = 10;         // length of a step, tenths of a cell
inline constexpr int kRouteDiagonal = 14;

struct RouteStep {
  int x, y, length;
};
inline constexpr std::array<RouteStep, 8> kRouteSteps{{{1, 0, kRouteStraight},
                                                       {0, 1, kRouteStraight},
                                                       {-1, 0, kRouteStraight},
                                                       {0, -1, kRouteStraight},
                                                       {1, 1, kRouteDiagonal},
                                                       {-1, 1, kRouteDiagonal},
                                                       {-1, -1, kRouteDiagonal},
                                                       {1, -1, kRouteDiagonal}}};

}  // namespace lakshya
