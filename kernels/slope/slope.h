// Ground that rises or falls: ramps, and the platforms that they lead to, as the continuation of the floor before the vehicle.
//
// The image is cut into vertical strips, a strip into bins of a few rows. The median of the residuals d - d_f of a bin, measured with
// two of its neighbours (of the three ways to take them the one whose pixels agree best), says where the strip's ground lies there, if
// nearly all of its pixels lie at it. From the lowest bin upwards the ground goes on as long as each bin is as high above or below
// the bins before it as a drivable slope allows. A wall, a kerb, the edge of a pothole rise or fall faster and end it.
// What a strip so knows to be ground away from the mount's plane gets the disparity that the plane has there, so that everything
// behind sees a level floor. All in integers. The profile of the ground over rows of disparity is the idea of R. Labayrade, D. Aubert,
// J.-P. Tarel, "Real time obstacle detection in stereovision on non flat road geometry through v-disparity representation", IV 2002.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"
#include "kernels/prune/prune.h"

namespace lakshya {

struct SlopeParams {
  int steepest_percent = 18;  // rise over way of the steepest ground that is driven; 0: none is looked for
  int tolerance_mm = 40;      // the mount's plane is good enough for ground that is no farther away from it
  int reach_mm = 6000;        // ahead; farther away steps look like slopes
  int drop_reach_mm = 2000;   // behind a slope the mount's plane says nothing about drop-offs that are farther away
};

inline constexpr int kSlopeStrips = 10;
inline constexpr int kSlopeBins = 60;           // of the image's height
inline constexpr int kSlopeSeenPercent = 50;    // of a bin's pixels that have a disparity
inline constexpr int kSlopeInlier = 8;          // 1/16 px about the median
inline constexpr int kSlopeInlierPercent = 80;  // of those that have one
inline constexpr int kSlopeNoise = 4;           // 1/16 px, of a median
inline constexpr int kSlopeLeftOut = 1;         // bins in a row that may say otherwise
inline constexpr int kSlopeStartBins = 4;       // that a strip's ground has at least
inline constexpr int kSlopeFollowed = 3;        // strips
inline constexpr int kSlopeEdgeBins = 2;        // the lowest, that do not say where it comes from
inline constexpr int kSlopeRunBins = 8;         // over which the first rise or fall is measured
inline constexpr int kSlopeFallMm = 70;         // to the ground beside: no lower side is driven over
inline constexpr int kSlopeSideMm = 400;        // what is higher stands on the ground
inline constexpr int kSlopeEdgeMm = 250;        // before the place where a slope falls steeply

// The ground's residual in 1/16 px in the middle of each bin, counted from the image's top.
struct SlopeStrip {
  int first = 0;  // bins [first, end) are known; none: the mount's plane is good enough
  int end = 0;
  std::array<std::int16_t, kSlopeBins> residual16{};
  std::array<bool, kSlopeBins> edge{};  // a side or a far end, that is not driven over: not levelled
  std::array<bool, kSlopeBins> fall{};  // a side that is high: a drop-off
  bool goes_on = false;                 // beyond what was measured
  std::int32_t forward_mm = 0;          // the last place that was
  std::int32_t height_mm = 0;

  bool found() const { return first < end; }
};
using Slopes = std::array<SlopeStrip, kSlopeStrips>;

// Of the whole image; `slopes` comes with those of the image before, or empty. Ground that begins away from the mount's plane is
// believed where that one had kSlopeFollowed of them and none begins on the plane in this one, else where it comes from the plane: seen
// back, it meets it before it is below the vehicle, as the top of a kerb does not. size_mismatch: the image is narrower than kSlopeStrips or lower than kSlopeBins.
Status find_slopes(const PruneModel& model, const SlopeParams& params, ImageView<const std::int16_t> disparity,
                   Slopes& slopes);

// Copies a strip of the image, 0 <= strip < kSlopeStrips: pixels that are floor once the ground's residual is taken out of them come
// without it. Above a slope's end in the image, what the mount's plane can say nothing about is too far (0): drop-offs beyond
// drop_reach_mm, and, where the slope goes on, what does not rise above it at its steepest. In the rows of a fall, what is no higher than
// kSlopeSideMm comes with a disparity that the plane takes for a drop-off just so. All others come as they are.
// size_mismatch (also: `levelled`), bad_argument: strip.
Status level_strip(const PruneModel& model, const SlopeParams& params, const Slopes& slopes,
                   ImageView<const std::int16_t> disparity, int strip, ImageView<std::int16_t> levelled);

}  // namespace lakshya
