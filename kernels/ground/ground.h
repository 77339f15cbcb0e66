// Visual ground estimate: how far the floor's disparity in this image is from what the camera's mount says.
//
// A pitch that is wrong by delta shifts the floor's disparity by about (f B / H) delta in the whole image, so that
// the residuals r = d - d_f(u,v) of floor pixels pile up at one value, while a wall spreads its residuals over its
// rows. The estimate is the fullest window of the residuals' histogram, and only when it stands out. Source: the
// idea of R. Labayrade, D. Aubert, J.-P. Tarel, "Real time obstacle detection in stereovision on non flat road
// geometry through v-disparity representation", IV 2002, with the mount's plane taken out first.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"
#include "kernels/prune/prune.h"

namespace lakshya {

// Residuals from -kGroundReach to +kGroundReach, 1/16 px each.
inline constexpr int kGroundReach = 16 * 16;
using GroundHistogram = std::array<std::uint32_t, 2 * kGroundReach + 1>;

// Half width of the window, 1/16 px: a floor's own scatter.
inline constexpr int kGroundWindow = 4;
// The window stands out when it holds this many times what evenly spread residuals would give it (at most this
// share of all residuals within the range), and this share of the image's pixels.
inline constexpr int kGroundContrast = 3;
inline constexpr int kGroundEnoughPercent = 60;
inline constexpr int kGroundMinImagePercent = 2;

// Adds the residuals of the rows to the histogram: pixels with a disparity nearer than the model's limit, where the
// floor can be matched and lies nearer than that limit itself. bad_argument (rows).
Status ground_residuals_ref(const PruneModel& mount, ImageView<const std::int16_t> disparity, Rows rows,
                            GroundHistogram& histogram);
Status ground_residuals_simd(const PruneModel& mount, ImageView<const std::int16_t> disparity, Rows rows,
                             GroundHistogram& histogram);

// The floor's offset in 1/16 px within +-range16 (at most kGroundReach): the mean residual of the fullest window
// (of two equally full ones the one nearer 0, then the positive one); 0 when none stands out. `pixels`: of the
// image.
std::int32_t ground_offset(const GroundHistogram& histogram, std::int32_t range16, std::int64_t pixels);

// How far the floor's own residuals scatter about `offset16` (of ground_offset), 1/16 px: half the width at half the height of their
// pile, on the narrower side (walls and things lie on the one, drop-offs on the other), as the standard deviation of a normal
// distribution of that width. At most kGroundScatterMost; 0 where there is no pile of kGroundMinImagePercent of the image.
std::int32_t ground_scatter(const GroundHistogram& histogram, std::int32_t offset16, std::int64_t pixels);
inline constexpr int kGroundScatterMost = 24;

}  // namespace lakshya
