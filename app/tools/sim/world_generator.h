// Obstacle courses by the number: the same seed gives the same world, on every machine with the same libm.
//
// Every world has a way from start to goal for a disc of 1.4 times the vehicle's width, at least 0.15 obstacles on each square metre
// within its boundary, and obstacles on the straight line, so that a vehicle must steer. 0.9 m round the start and 0.8 m round the
// goal are free, and the start faces the goal within 40 degrees.
#pragma once

#include <cstdint>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

enum class Kind : std::uint8_t { indoor, outdoor };

inline constexpr double kWayRadiusM = 0.49;    // 1.4 x 0.35 m
inline constexpr double kLeastDensity = 0.15;  // obstacles per square metre

World random_world(Kind kind, std::uint64_t seed);

}  // namespace lakshya::sim
