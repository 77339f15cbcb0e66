// Calibrations as the data sets write them, with numbers that are easy to check by hand.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace lakshya::test {

// The text with `from`, which must be there, replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's text has no " + from);
  return text.replace(at, from.size(), to);
}

// Grey pair: f = 700, B = 350 / 700 = 0.5 m. Colour pair: t = (0.0625, -0.001, 0.002) and (-0.4725, 0.002, 0.003) m.
inline std::string kitti_calib() {
  return "P0: 7.000000000000e+02 0.000000000000e+00 6.000000000000e+02 0.000000000000e+00 0.000000000000e+00 "
         "7.000000000000e+02 1.800000000000e+02 0.000000000000e+00 0.000000000000e+00 0.000000000000e+00 "
         "1.000000000000e+00 0.000000000000e+00\n"
         "P1: 7.0e+02 0 6.0e+02 -3.5e+02 0 7.0e+02 1.8e+02 0 0 0 1 0\n"
         "P2: 7.0e+02 0 6.0e+02 4.495e+01 0 7.0e+02 1.8e+02 -3.4e-01 0 0 1 2.0e-03\n"
         "P3: 7.0e+02 0 6.0e+02 -3.2895e+02 0 7.0e+02 1.8e+02 1.94e+00 0 0 1 3.0e-03\n"
         "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n";
}

// The camera looks along the body's x axis; left at y = +0.06 m, right at y = -0.05 m: B = 0.11 m.
inline std::string euroc_sensor(const std::string& y, const std::string& cx = "80") {
  return "%YAML:1.0\n"
         "# General sensor definitions.\n"
         "sensor_type: camera\n"
         "comment: cam\n"
         "T_BS:\n"
         "  cols: 4\n"
         "  rows: 4\n"
         "  data: [0.0, 0.0, 1.0, 0.02,\n"
         "         -1.0, 0.0, 0.0, " +
         y +
         ",\n"
         "         0.0, -1.0, 0.0, 0.01,\n"
         "         0.0, 0.0, 0.0, 1.0]\n"
         "rate_hz: 20\n"
         "resolution: [160, 120]\n"
         "camera_model: pinhole\n"
         "intrinsics: [100.5, 100.25, " +
         cx +
         ", 60] #fu, fv, cu, cv\n"
         "distortion_model: radial-tangential\n"
         "distortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]\n";
}

// tx: the projection's P(0,3) = -f B in px m; B = 0.12 m for "-10.8".
inline std::string ros_camera_info(const std::string& name, const std::string& tx) {
  return "image_width: 160\n"
         "image_height: 120\n"
         "camera_name: " +
         name +
         "\n"
         "camera_matrix:\n"
         "  rows: 3\n"
         "  cols: 3\n"
         "  data: [100, 0, 81, 0, 101, 61, 0, 0, 1]\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients:\n"
         "  rows: 1\n"
         "  cols: 5\n"
         "  data: [0.1, 0.2, 0.3, 0.4, 0.5]\n"
         "rectification_matrix:\n"
         "  rows: 3\n"
         "  cols: 3\n"
         "  data: [0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8]\n"
         "projection_matrix:\n"
         "  rows: 3\n"
         "  cols: 4\n"
         "  data: [90, 0, 80, " +
         tx + ", 0, 90, 60, 0, 0, 0, 1, 0]\n";
}

}  // namespace lakshya::test
