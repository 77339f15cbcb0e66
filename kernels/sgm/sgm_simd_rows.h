// The rows that sgm_simd keeps of one band, laid out in the caller's scratch.
//
// Candidates lie side by side, `pitch` bytes per pixel: the disparities, and up to the next whole vector the value 255,
// which no minimum takes; a row has a pixel of margin on both sides. In the rows of sums and of paths from above, a
// vector of 255 lies behind every pixel, so that a vector that starts before a pixel's candidates or ends after them
// meets nothing else there. The right image's codes lie in reverse, so that the candidates of pixel u are the bytes from y = width - 1 - u on (of
// right pixel width - 1 - first - y), one load per vector.
//
// All rows of a band together should fit the cache, so a row is kept no longer than it is needed: the sum of three rows
// of distances and then C take the place of the distances that are no longer wanted, and S that of the path from the
// right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/scratch.h"
#include "kernels/census/census.h"

namespace lakshya {

inline constexpr std::size_t kMaxVectorBytes = 64;
inline constexpr int kMaxCodePlanes = 4;  // a code is taken apart into planes of 4 or 8 bits
inline constexpr int kMaxTopPaths = 3;

struct SgmSimdRows {
  std::span<std::uint32_t> left_planes;                  // per pixel its planes, each in all four bytes of a word
  std::span<std::uint8_t> right_planes[kMaxCodePlanes];  // reversed
  std::span<CensusCode> right_codes;                     // reversed
  std::span<std::uint8_t> right_valid;                   // 255 where that right pixel has a descriptor, reversed
  // Of the row above, this one and the one below; the first then holds C, that of pixel u at the place of u + 1.
  std::span<std::uint8_t> hamming[3];
  std::span<std::uint8_t> sums;                   // L of the path from the right, then S of the row
  std::span<std::uint8_t> above[kMaxTopPaths];    // L of the row above
  std::span<std::uint8_t> current[kMaxTopPaths];  // L of this row; path 0, straight down, overwrites the row above
  std::span<std::uint8_t> above_least[kMaxTopPaths];  // their least per pixel
  std::span<std::uint8_t> current_least[kMaxTopPaths];
  std::span<std::uint8_t> beyond;                     // 0 for a disparity, 255 beyond the last one
  std::span<std::uint8_t> side_penalty;               // P2 between pixels u - 1 and u
  std::span<std::uint8_t> top_penalty[kMaxTopPaths];  // P2 between pixel u and the path's pixel above
  // Of each left pixel: the winner; S before it, its own and S after it, from the lowest byte up; a bit for each other
  // candidate that is nearly as good.
  std::span<std::int32_t> winner;
  std::span<std::uint32_t> winner_sums;
  std::span<std::uint64_t> rivals;
  std::span<std::int16_t> right_winner;  // candidate that a right pixel matches best, reversed
};

inline SgmSimdRows lay_out_sgm_simd(int width, int disparities, ScratchLayout& scratch) {
  constexpr std::size_t kMargin = 2 * kMaxVectorBytes;  // vectors reach over the ends
  const auto columns = static_cast<std::size_t>(width);
  const std::size_t pitch =
      (static_cast<std::size_t>(disparities) + kMaxVectorBytes - 1) / kMaxVectorBytes * kMaxVectorBytes;
  const std::size_t row = (columns + 2) * pitch + kMargin;
  const std::size_t spaced_row = (columns + 2) * (pitch + kMaxVectorBytes) + kMargin;
  const std::size_t reversed = columns + pitch + kMargin;
  SgmSimdRows r;
  r.left_planes = scratch.take<std::uint32_t>(kMaxCodePlanes * columns + kMargin);
  for (auto& plane : r.right_planes)
    plane = scratch.take<std::uint8_t>(reversed);
  r.right_codes = scratch.take<CensusCode>(reversed);
  r.right_valid = scratch.take<std::uint8_t>(reversed);
  for (auto& distances : r.hamming)
    distances = scratch.take<std::uint8_t>(row);
  r.sums = scratch.take<std::uint8_t>(spaced_row);
  for (int path = 0; path < kMaxTopPaths; ++path) {
    r.above[path] = scratch.take<std::uint8_t>(spaced_row);
    r.current[path] = path == 0 ? r.above[path] : scratch.take<std::uint8_t>(spaced_row);
    r.top_penalty[path] = scratch.take<std::uint8_t>(columns);
  }
  r.beyond = scratch.take<std::uint8_t>(pitch);
  r.side_penalty = scratch.take<std::uint8_t>(columns + 1);
  r.winner = scratch.take<std::int32_t>(columns + kMargin);
  r.winner_sums = scratch.take<std::uint32_t>(columns + kMargin);
  r.rivals = scratch.take<std::uint64_t>(columns + kMargin);
  r.right_winner = scratch.take<std::int16_t>(reversed + 2);
  return r;
}

}  // namespace lakshya
