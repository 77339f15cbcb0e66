// Lists of stereo pairs for `lakshya compare --pairs`: perf/compare_pairs.json, and perf/accuracy_pairs.json as it is.
#pragma once

#include <string>
#include <vector>

#include "app/tools/stereo_input.h"

namespace lakshya {

// left and right, or sequence and frame; calib; names relative to the data's folder. `sets`: as --set, from
// disparities, min_disparity and set.
struct ComparedPair {
  std::string name;
  StereoInputOptions input;
  std::vector<std::string> sets;
};

// Throws InputError for a list that is not one.
std::vector<ComparedPair> read_compared_pairs(const std::string& path, const std::string& data);

// The images, with their calibration, or where the list names none with that of a made-up rig of their size: for a
// comparison any geometry will do.
StereoInput read_compared_pair(const ComparedPair& pair, double opencv_unit_m);

}  // namespace lakshya
