#include "app/core/calibration_yaml.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Nodes = std::map<std::string, YAML::Node>;

constexpr int kMaxEntries = 64;

Nodes unique_entries(const InputKey& key, const YAML::Node& map) {
  Nodes nodes;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) key.refuse("a key is not a name (write KEY: VALUE)");
    if (!nodes.emplace(entry.first.Scalar(), entry.second).second) {
      key.refuse(shown(entry.first.Scalar()) + " is given twice (keep one)");
    }
  }
  return nodes;
}

double scalar(const InputKey& key, const YAML::Node& node) {
  if (!node.IsScalar()) key.refuse("holds a list or a map where a number belongs (write decimal numbers)");
  return parse_number(key, node.Scalar());
}

// Aliases can repeat a long list without end.
void require_short(const InputKey& key, const YAML::Node& list) {
  if (list.size() > kMaxEntries) key.refuse("more than 64 entries (write a matrix)");
}

CalibrationTable parse_list(const InputKey& key, const YAML::Node& list) {
  require_short(key, list);
  CalibrationTable table;
  table.flat = list.size() == 0 || !list[0].IsSequence();
  table.rows = table.flat ? 1 : static_cast<int>(list.size());
  table.cols = static_cast<int>(table.flat ? list.size() : list[0].size());
  for (const YAML::Node& row : list) {
    if (table.flat) {
      table.values.push_back(scalar(key, row));
      continue;
    }
    require_short(key, row);
    if (!row.IsSequence() || row.size() != static_cast<std::size_t>(table.cols)) {
      key.refuse("its rows differ in length (write rows of one length)");
    }
    for (const YAML::Node& value : row)
      table.values.push_back(scalar(key, value));
  }
  return table;
}

int require_count(const InputKey& key, const Nodes& nodes, const char* name) {
  const auto found = nodes.find(name);
  if (found == nodes.end()) key.refuse(std::string(name) + " is missing (a matrix has rows, cols, dt and data)");
  const double count = scalar(key, found->second);
  if (count >= 0 && count <= kMaxEntries && count == std::floor(count)) return static_cast<int>(count);
  key.refuse(std::string(name) + " " + shown(count) + " is not an integer in 0..64 (write the matrix again)");
}

void require_one_channel(const InputKey& key, const YAML::Node& type) {
  const std::string dt = type.IsScalar() ? type.Scalar() : "";
  if (dt.size() == 1 && std::string_view("ucwsifd").find(dt[0]) != std::string_view::npos) return;
  key.refuse("element type " + shown(dt) + " is not a number of one channel (write the matrix as dt: d)");
}

CalibrationTable parse_opencv_matrix(const InputKey& key, const YAML::Node& map) {
  const Nodes nodes = unique_entries(key, map);
  const int rows = require_count(key, nodes, "rows");
  const int cols = require_count(key, nodes, "cols");
  const auto type = nodes.find("dt");
  if (type != nodes.end()) require_one_channel(key, type->second);
  const auto data = nodes.find("data");
  if (data == nodes.end() || !data->second.IsSequence()) {
    key.refuse("data is missing (a matrix has rows, cols, dt and data)");
  }
  CalibrationTable table = parse_list(key, data->second);
  if (!table.flat || table.values.size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols)) {
    key.refuse("data has not rows x cols numbers (write the matrix again)");
  }
  table.rows = rows;
  table.cols = cols;
  table.flat = false;
  return table;
}

YAML::Node load_yaml(const std::string& text, const std::string& source) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw InputError(source, "YAML: line " + std::to_string(e.mark.line + 1) + ": " + e.msg + " (fix the line)");
  }
}

}  // namespace

CalibrationYaml::CalibrationYaml(std::string text, const std::string& source, std::string hint)
    : source_(source), hint_(std::move(hint)) {
  // OpenCV's first line is no YAML directive; as a comment it leaves the line numbers as they are.
  if (text.starts_with("%YAML:")) text[0] = '#';
  const YAML::Node root = load_yaml(text, source);
  if (!root.IsMap()) key("YAML").refuse("not a list of KEY: VALUE (" + hint_ + ")");
  nodes_ = unique_entries(key("YAML"), root);
}

const YAML::Node& CalibrationYaml::at(const std::string& name) const {
  const auto found = nodes_.find(name);
  if (found == nodes_.end()) key(name).refuse("missing (" + hint_ + ")");
  return found->second;
}

double CalibrationYaml::number(const std::string& name) const {
  return scalar(key(name), at(name));
}

std::string CalibrationYaml::text(const std::string& name) const {
  const YAML::Node& node = at(name);
  if (!node.IsScalar()) key(name).refuse("holds a list or a map where a word belongs (write KEY: VALUE)");
  return node.Scalar();
}

CalibrationTable CalibrationYaml::table(const std::string& name) const {
  const YAML::Node& node = at(name);
  if (node.IsMap()) return parse_opencv_matrix(key(name), node);
  if (node.IsSequence()) return parse_list(key(name), node);
  key(name).refuse("not a matrix (write an !!opencv-matrix or a list of rows)");
}

std::vector<double> CalibrationYaml::vector(const std::string& name) const {
  CalibrationTable table = this->table(name);
  if (!table.is_vector()) {
    key(name).refuse(std::to_string(table.rows) + "x" + std::to_string(table.cols) +
                     " numbers where one row belongs (write one row)");
  }
  return std::move(table.values);
}

void CalibrationYaml::require_shape(const std::string& name, const CalibrationTable& table, int rows,
                                    int cols) const {
  if (table.has_shape(rows, cols)) return;
  key(name).refuse(std::to_string(table.rows) + "x" + std::to_string(table.cols) + " numbers where " +
                   std::to_string(rows) + "x" + std::to_string(cols) + " belong (write the matrix again)");
}

}  // namespace lakshya
