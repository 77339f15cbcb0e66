// What `lakshya bench` measures on: a rectified pair, and the raw pair that a rig with real lenses would have taken of it.
#pragma once

#include <cstdint>
#include <string>

#include "app/core/calibration.h"
#include "app/core/image.h"

namespace lakshya {

// A rectified pair from files; empty: the made-up scene (bench_scene.h).
struct BenchPair {
  std::string left;
  std::string right;
  int shift = 0;  // px of the files; disparities become smaller by it
};

struct BenchInput {
  StereoCalibration calibration;  // of the raw pair
  Image<std::uint8_t> left;       // rectified
  Image<std::uint8_t> right;
  Image<std::uint8_t> raw_left;
  Image<std::uint8_t> raw_right;
};

// Files are cropped to the shape asked for and scaled. The rig: two wide-angle lenses, barrel distortion, half a degree
// out of line; its baseline puts the nearest surface of the made-up scene at 9/10 of the disparities searched.
// Throws InputError.
BenchInput make_bench_input(int width, int height, int disparities, const BenchPair& pair);

}  // namespace lakshya
