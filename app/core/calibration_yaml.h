// Private to the calibration readers: a YAML file as named numbers, names and matrices.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "app/core/calibration_checks.h"

namespace lakshya {

// A matrix as the file states it; a flat list has no shape of its own.
struct CalibrationTable {
  int rows = 0;
  int cols = 0;
  bool flat = false;
  std::vector<double> values;

  bool is_vector() const { return flat || rows == 1 || cols == 1 || values.empty(); }
  bool has_shape(int r, int c) const {
    if (values.size() != static_cast<std::size_t>(r) * static_cast<std::size_t>(c)) return false;
    return flat || (rows == r && cols == c) || (is_vector() && (r == 1 || c == 1));
  }
};

// Every accessor throws InputError when the key is missing or holds something else; the constructor where the text
// is no YAML, and where a key is given twice. OpenCV's first line "%YAML:1.0" is allowed. Refers to the source.
class CalibrationYaml {
 public:
  // hint: what such a file has, for the refusal of a missing key.
  CalibrationYaml(std::string text, const std::string& source, std::string hint);

  InputKey key(const std::string& name) const { return {source_, name}; }
  bool has(const std::string& name) const { return nodes_.contains(name); }
  double number(const std::string& name) const;
  std::string text(const std::string& name) const;

  // An !!opencv-matrix, a flat list or a list of rows, of at most 64 x 64 numbers.
  CalibrationTable table(const std::string& name) const;

  // The same of one row or one column.
  std::vector<double> vector(const std::string& name) const;

  template <int kRows, int kCols>
  Eigen::Matrix<double, kRows, kCols> matrix(const std::string& name) const {
    const CalibrationTable t = table(name);
    require_shape(name, t, kRows, kCols);
    Eigen::Matrix<double, kRows, kCols> m;
    for (int i = 0; i < kRows * kCols; ++i)
      m(i / kCols, i % kCols) = t.values[static_cast<std::size_t>(i)];
    return m;
  }

 private:
  const YAML::Node& at(const std::string& name) const;
  void require_shape(const std::string& name, const CalibrationTable& table, int rows, int cols) const;

  const std::string& source_;
  std::string hint_;
  std::map<std::string, YAML::Node> nodes_;
};

}  // namespace lakshya
