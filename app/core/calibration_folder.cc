#include <array>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/core/calibration_file.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

struct TwoFiles {
  const char* left;
  const char* right;
};

constexpr std::array<TwoFiles, 4> kPairs{{{"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"},
                                          {"cam0/sensor.yaml", "cam1/sensor.yaml"},
                                          {"cam0_sensor.yaml", "cam1_sensor.yaml"},
                                          {"left.yaml", "right.yaml"}}};
constexpr std::array<const char*, 10> kSingles{
    "calib.txt",       "calib_cam_to_cam.txt", "calib.yaml", "calib.yml",         "calibration.yaml",
    "calibration.yml", "stereo.yaml",          "stereo.yml", "stereo_calib.yaml", "stereo_calib.yml"};

bool exists(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

[[noreturn]] void refuse_none(const std::string& folder) {
  std::string looked_for;
  for (const TwoFiles& pair : kPairs)
    looked_for += std::string(pair.left) + " and " + pair.right + ", ";
  for (const char* name : kSingles)
    looked_for += std::string(name) + (name == kSingles.back() ? "" : ", ");
  throw InputError(folder, "calibration: none found in this folder; looked for " + looked_for +
                               " (name the file or the two files)");
}

}  // namespace

std::vector<std::string> find_calibration(const std::string& folder) {
  std::vector<std::vector<std::string>> found;
  for (const TwoFiles& pair : kPairs) {
    const std::string left = folder + "/" + pair.left;
    const std::string right = folder + "/" + pair.right;
    if (!exists(left) && !exists(right)) continue;
    if (!exists(right))
      throw InputError(right, "calibration: missing beside " + left + " (both cameras' are needed)");
    if (!exists(left))
      throw InputError(left, "calibration: missing beside " + right + " (both cameras' are needed)");
    found.push_back({left, right});
  }
  for (const char* name : kSingles) {
    if (exists(folder + "/" + name)) found.push_back({folder + "/" + name});
  }
  if (found.empty()) refuse_none(folder);
  if (found.size() > 1) {
    throw InputError(folder, "calibration: both " + found[0].front() + " and " + found[1].front() +
                                 " are there (name the one to use)");
  }
  return found.front();
}

}  // namespace lakshya
