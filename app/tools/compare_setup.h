// What the pipeline works out at start, for `lakshya compare`, which calls the kernels one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "app/core/pipeline.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {

struct CompareSetup {
  // The images, of one size, and the configuration are kept by reference. Throws InputError as Pipeline does.
  CompareSetup(const VehicleConfig& vehicle, const StereoCalibration& stereo,
               ImageView<const std::uint8_t> left_raw, ImageView<const std::uint8_t> right_raw);

  // The configuration with another matcher.
  MatcherConfig matcher(const char* name) const;
  Rows band(int index) const { return rows_of_band(height, config.matcher.bands, index); }

  const VehicleConfig& config;
  const StereoCalibration& calibration;
  ImageView<const std::uint8_t> left, right;  // raw
  int width;
  int height;
  RectifiedGeometry camera;
  bool remap;
  RectifyMaps maps_left, maps_right;
  std::vector<std::int32_t> depth_table, height_table;
  PruneModel mount;
  std::vector<CellThresholds> thresholds;
  std::int32_t min_height_mm;
  std::vector<PolarEntry> polar_table;
  Planner planner;
  MonotonicClock clock;
};

}  // namespace lakshya
