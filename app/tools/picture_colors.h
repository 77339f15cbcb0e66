// Colours of the pictures, one meaning each. The categorical ones are chosen to stay apart for colour-blind
// readers; sources: M. Okabe and K. Ito, "Color Universal Design" (2008), and the pair DC3220, 005AB5 of D.
// Nichols, "Coloring for Colorblindness".
#pragma once

#include <cstdint>

#include "app/core/image.h"
#include "kernels/base/units.h"

namespace lakshya {

inline constexpr Rgb8 kPaper{255, 255, 255};
inline constexpr Rgb8 kInk{25, 28, 32};
inline constexpr Rgb8 kFaintInk{110, 114, 120};
inline constexpr Rgb8 kRule{205, 208, 212};
inline constexpr Rgb8 kNoDisparityColor{46, 46, 50};

inline constexpr Rgb8 kFreeCell{250, 250, 248};
inline constexpr Rgb8 kUnknownCell{176, 178, 182};
inline constexpr Rgb8 kOutsideMap{226, 228, 231};
inline constexpr Rgb8 kDropOffCell{110, 20, 105};

inline constexpr Rgb8 kOpeningColor{0, 158, 115};
inline constexpr Rgb8 kChosenColor{0, 90, 181};
inline constexpr Rgb8 kTargetColor{20, 20, 20};
inline constexpr Rgb8 kViewColor{90, 96, 104};
inline constexpr Rgb8 kActiveColor{86, 130, 190};
inline constexpr Rgb8 kVehicleColor{230, 159, 0};
inline constexpr Rgb8 kBlockedColor{220, 50, 32};
inline constexpr Rgb8 kMaskedColor{230, 159, 0};

// a where share = 0, b where share = 1.
Rgb8 mix(Rgb8 a, Rgb8 b, double share);

// Turbo, t in 0..1 (clamped) from dark blue to dark red: A. Mikhailov, "Turbo, An Improved Rainbow Colormap for
// Visualization" (2019), the fifth-degree polynomials that he and R. Du published for it.
Rgb8 turbo(double t);

// Disparity (px) on a scale from 0 to `largest`; starts above turbo's nearly black end, so that a far
// pixel does not look like one without disparity.
Rgb8 disparity_color(double disparity_px, double largest_px);

// Obstacle cell by the mean height of its points: brown on the ground to nearly black at the clearance height.
Rgb8 height_color(double height_m, double clearance_m);

// A grey value tinted by its pixel's class and, without disparity, by the reason (a NoDisparity code; >= 0: the
// pixel has one, but pruning concluded nothing from it).
Rgb8 class_color(PixelClass pixel_class, std::int16_t disparity, std::uint8_t gray);

}  // namespace lakshya
