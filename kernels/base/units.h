// Units and codes shared by every kernel: docs/contract.md sections 1 to 4. No logic.
#pragma once

#include <cstdint>

namespace lakshya {

// Disparity: int16, 1/16 px. Zero is a valid disparity (a point at infinity).
inline constexpr int kDisparityBits = 4;
inline constexpr int kDisparityScale = 1 << kDisparityBits;
inline constexpr int kDisparityToQ16 = 16 - kDisparityBits;  // shift from 1/16 px to Q16 px

// A negative disparity says why there is none.
enum NoDisparity : std::int16_t {
  kNotSearched = -1,      // image border, or no candidate inside the other image
  kLowTexture = -2,       // too little texture to match
  kNotUnique = -3,        // a second candidate is nearly as good
  kLeftRightFailed = -4,  // left-to-right and right-to-left matches disagree
  kNoSupport = -5,        // too few neighbours agree (speckle)
  kPrunedEarly = -6,      // pruned before matching
};
inline constexpr int kNoDisparityReasons = 6;

// What pruning decided about a pixel (docs/contract.md section 3).
enum class PixelClass : std::uint8_t {
  no_disparity = 0,
  too_far = 1,
  drop_off = 2,
  floor = 3,
  ceiling = 4,
  obstacle = 5,
};
inline constexpr int kPixelClasses = 6;

// Type of a navigation-map cell: the paper's values.
enum CellType : std::uint8_t {
  kCellObstacle = 0,
  kCellUnoccupied = 1,
  kCellUnknown = 2,
};

}  // namespace lakshya
