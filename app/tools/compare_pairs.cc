#include "app/tools/compare_pairs.h"

#include <nlohmann/json.hpp>

#include "app/core/calibration_file.h"
#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/lakshyad/options.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxListBytes = 1 << 20;

ComparedPair compared_pair(const Json& entry, const std::string& data) {
  const auto file = [&](const Json& name) { return data + "/" + name.get<std::string>(); };
  ComparedPair pair;
  pair.name = entry.at("name").get<std::string>();
  if (entry.contains("sequence")) {
    pair.input.sequence = file(entry["sequence"]);
    pair.input.frame = entry.at("frame").get<int>();
  } else {
    pair.input.left = file(entry.at("left"));
    pair.input.right = file(entry.at("right"));
  }
  if (entry.contains("calib")) pair.input.calibration = {file(entry["calib"])};
  const int disparities = round_up_to_16(entry.at("disparities").get<int>());
  pair.sets.push_back("matcher.disparities=" + std::to_string(disparities));
  if (entry.contains("min_disparity")) {
    pair.sets.push_back("matcher.min_disparity=" + std::to_string(entry["min_disparity"].get<int>()));
  }
  for (const Json& set : entry.value("set", Json::array()))
    pair.sets.push_back(set.get<std::string>());
  return pair;
}

StereoCalibration made_up_rig(const std::string& source, int width, int height) {
  StereoCalibration c;
  c.source = source;
  c.width = width;
  c.height = height;
  const auto focal = static_cast<double>(width);
  c.left = {.fx = focal, .fy = focal, .cx = (width - 1) / 2.0, .cy = (height - 1) / 2.0};
  c.right = c.left;
  c.T = {-0.2, 0, 0};
  c.images_rectified = true;
  return c;
}

}  // namespace

std::vector<ComparedPair> read_compared_pairs(const std::string& path, const std::string& data) {
  try {
    std::vector<ComparedPair> pairs;
    for (const Json& entry : Json::parse(read_text(path, kMaxListBytes)))
      pairs.push_back(compared_pair(entry, data));
    return pairs;
  } catch (const Json::exception& e) {
    throw InputError(path, std::string("list of pairs: ") + e.what() + " (see perf/compare_pairs.json)");
  }
}

StereoInput read_compared_pair(const ComparedPair& pair, double opencv_unit_m) {
  if (!pair.input.sequence.empty() || !pair.input.calibration.empty()) {
    return read_stereo_input(pair.input, opencv_unit_m);
  }
  StereoInput input;
  input.left_path = pair.input.left;
  input.right_path = pair.input.right;
  input.left = read_gray(input.left_path);
  input.right = read_gray(input.right_path);
  input.calibration = made_up_rig(input.left_path, input.left.width(), input.left.height());
  require_image_size(input.calibration, input.right.width(), input.right.height(), input.right_path);
  return input;
}

}  // namespace lakshya
