// A made-up but natural scene for measurements: textured floor, walls, boxes, a pole and a board overhead, ray by ray.
// Matchers behave differently on noise, and a measurement must not need files. The same call gives the same image.
#pragma once

#include "app/core/calibration.h"
#include "app/core/image.h"

namespace lakshya {

// Mount of the camera that the scene is made for.
inline constexpr double kBenchCameraHeightM = 0.6;
inline constexpr double kBenchCameraPitchDeg = 5.0;
// Depth of the nearest surface in view, the floor below the image's bottom row, for the lens of bench_input.cc.
inline constexpr double kBenchNearestM = 0.75;

// What the left camera of the rectified pair sees, or the right one, a baseline beside it.
enum class BenchCamera { left, right };
Image<std::uint8_t> render_bench_scene(const RectifiedGeometry& geometry, BenchCamera camera);

}  // namespace lakshya
