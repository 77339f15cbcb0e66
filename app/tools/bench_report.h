// What `lakshya bench` prints and writes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/tools/bench_setting.h"

namespace lakshya {

nlohmann::ordered_json bench_json(const BenchResult& result);
// For a terminal.
std::string bench_text(const BenchResult& result);

// How the OpenCV that is compared with was built, and what this processor lets it use.
struct OpencvBuild {
  std::string version;
  std::string baseline;    // what every function may use
  std::string dispatched;  // what some files are compiled for again, chosen at run time
  std::string parallel;    // its threads
  std::string processor;   // cv::getCPUFeaturesLine: *: dispatched and usable here, ?: not usable here
};
OpencvBuild opencv_build();
nlohmann::ordered_json opencv_build_json(const OpencvBuild& build);
std::string opencv_build_text(const OpencvBuild& build);

// "1.234", three significant digits.
std::string milliseconds(double ms);

}  // namespace lakshya
