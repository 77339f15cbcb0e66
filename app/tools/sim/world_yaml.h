// Private to the reader of world files: a YAML map whose keys are all known, asked for values that are checked.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "app/tools/sim/ground_shapes.h"

namespace lakshya::sim {

// One value and where it stands. Everything throws InputError: "file:line: what: why (what to do)".
class YamlValue {
 public:
  YamlValue(const YAML::Node& node, const std::string& source, std::string what, int line);

  [[noreturn]] void refuse(const std::string& why) const;
  double number(double low, double high) const;
  int integer(int low, int high) const;
  bool yes() const;
  std::string text() const;
  std::string_view one_of(const std::vector<std::string_view>& known) const;
  Eigen::Vector2d point() const;  // [x, y]
  Rect rect() const;              // [x0, y0, x1, y1]
  std::vector<double> numbers(std::size_t count, double low, double high) const;
  std::vector<YamlValue> list(std::size_t most) const;

  const YAML::Node& node() const { return node_; }
  const std::string& source() const { return source_; }
  const std::string& what() const { return what_; }
  int line() const { return line_; }

 private:
  YAML::Node node_;
  const std::string& source_;  // outlives the reading
  std::string what_;
  int line_;
};

class YamlMap {
 public:
  // Refuses keys that are not in `known`, and keys given twice.
  YamlMap(const YamlValue& value, const std::vector<std::string_view>& known);

  bool has(std::string_view key) const;
  YamlValue at(std::string_view key) const;  // refuses when it is missing
  double number(std::string_view key, double fallback, double low, double high) const;
  const YamlValue& value() const { return value_; }

 private:
  YamlValue value_;
  std::vector<std::pair<std::string, YamlValue>> entries_;
};

// The whole text. Throws for broken YAML.
YAML::Node load_yaml(std::string_view text, const std::string& source);

}  // namespace lakshya::sim
