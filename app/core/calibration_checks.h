// Private to the calibration readers: named lines, and the checks that the formats share.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/core/calibration.h"
#include "app/core/input_text.h"

namespace lakshya {

using Projection = Eigen::Matrix<double, 3, 4>;

// A text of lines NAME separator VALUE; other lines are ignored, a name given twice is refused. Refers to the text
// and the source.
class CalibrationLines {
 public:
  // hint: what such a file has, for the refusal of a missing name.
  CalibrationLines(std::string_view text, const std::string& source, char separator, std::string hint);

  InputKey key(const std::string& name) const { return {source_, name}; }
  bool has(const std::string& name) const { return values_.contains(name); }
  std::string_view at(const std::string& name) const;
  double number(const std::string& name) const { return parse_number(key(name), at(name)); }

 private:
  const std::string& source_;
  std::string hint_;
  std::map<std::string, std::string_view> values_;
};

// An image width or height: an integer in 1..16384.
int require_side(const InputKey& key, double value);

// Focal lengths and principal point; the size is 0 x 0 where the file states none.
void require_plausible(const InputKey& key, const CameraModel& camera, int width, int height);

// what_to_do ends the message: formats differ in their units.
void require_plausible_baseline(const InputKey& key, double metres, const std::string& what_to_do);

// T of x_right = R x_left + T, in metres: a plausible baseline, mainly along -x.
void require_side_by_side(const InputKey& key, const Eigen::Vector3d& t, const std::string& what_to_do);

// R R^T = I to 1e-3, right-handed.
void require_rotation(const InputKey& key, const Eigen::Matrix3d& r);

// k1 k2 p1 p2 k3.. in OpenCV's order, one of `counts` of them; a tilted sensor (coefficients 13, 14) is refused.
void set_distortion(const InputKey& key, const std::vector<double>& values,
                    std::initializer_list<std::size_t> counts, CameraModel& camera);

// [fx 0 cx; 0 fy cy; 0 0 1]
void require_camera_matrix(const InputKey& key, const Eigen::Matrix3d& k);

// Focal lengths and principal point of a camera matrix, or of the first three columns of a projection.
CameraModel camera_of(const Eigen::Matrix3d& k);

// The right camera's size, which the key names, is the left one's.
void require_size_of_left(const InputKey& key, int left_width, int left_height, int width, int height);

// P = [f 0 cx Tx*f; 0 f cy 0; 0 0 1 0] with plausible numbers.
void require_projection(const InputKey& key, const Projection& p, int width, int height);

// Left and right projections have one focal length and one cy. The key is the right one's.
void require_same_rows(const InputKey& key, const Projection& left, const Projection& right);

}  // namespace lakshya
