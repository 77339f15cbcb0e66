#include "app/tools/sim/world_yaml.h"

#include <algorithm>
#include <cmath>

#include "app/core/input_error.h"
#include "app/core/input_text.h"

namespace lakshya::sim {
namespace {

constexpr double kFarthestM = 500;

std::string listed(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names)
    list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

int line_of(const YAML::Node& node, int otherwise) {
  return node.Mark().is_null() ? otherwise : node.Mark().line + 1;
}

}  // namespace

YamlValue::YamlValue(const YAML::Node& node, const std::string& source, std::string what, int line)
    : node_(node), source_(source), what_(std::move(what)), line_(line) {}

void YamlValue::refuse(const std::string& why) const {
  throw InputError(source_ + ":" + std::to_string(line_), what_ + ": " + why);
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) refuse("not a single value (write \"key: value\")");
  const std::string& text = node_.Scalar();
  if (text.empty() || text.size() > 100) refuse("not of 1 to 100 characters (shorten it)");
  return text;
}

double YamlValue::number(double low, double high) const {
  const std::string where = source_ + ":" + std::to_string(line_);
  const double value = parse_number({where, what_}, text());
  if (value < low || value > high)
    refuse(shown(value) + " is outside " + shown(low) + ".." + shown(high) + " (choose a value in it)");
  return value;
}

int YamlValue::integer(int low, int high) const {
  const double value = number(low, high);
  if (value != std::floor(value)) refuse(shown(value) + " is not a whole number (round it)");
  return static_cast<int>(value);
}

bool YamlValue::yes() const {
  return one_of({"true", "false"}) == "true";
}

std::string_view YamlValue::one_of(const std::vector<std::string_view>& known) const {
  const std::string value = text();
  const auto found = std::find(known.begin(), known.end(), value);
  if (found == known.end()) refuse(shown(value) + " is unknown (known: " + listed(known) + ")");
  return *found;
}

std::vector<YamlValue> YamlValue::list(std::size_t most) const {
  if (!node_.IsSequence()) refuse("not a list (write [a, b] or lines with \"- \")");
  if (node_.size() > most) refuse("more than " + std::to_string(most) + " entries (leave some out)");
  std::vector<YamlValue> values;
  for (const YAML::Node& node : node_)
    values.emplace_back(node, source_, what_, line_of(node, line_));
  return values;
}

std::vector<double> YamlValue::numbers(std::size_t count, double low, double high) const {
  std::vector<double> numbers;
  if (!node_.IsSequence() || node_.size() != count)
    refuse("not a list of " + std::to_string(count) + " numbers (write [a, b, ...])");
  for (const YamlValue& value : list(count))
    numbers.push_back(value.number(low, high));
  return numbers;
}

Eigen::Vector2d YamlValue::point() const {
  const auto xy = numbers(2, -kFarthestM, kFarthestM);
  return {xy[0], xy[1]};
}

Rect YamlValue::rect() const {
  const auto v = numbers(4, -kFarthestM, kFarthestM);
  if (!(v[2] - v[0] >= 0.01 && v[3] - v[1] >= 0.01))
    refuse("less than 1 cm long or wide (write [x0, y0, x1, y1] with x0 < x1 and y0 < y1)");
  return {v[0], v[1], v[2], v[3]};
}

YamlMap::YamlMap(const YamlValue& value, const std::vector<std::string_view>& known) : value_(value) {
  if (!value.node().IsMap()) value.refuse("not a map (write \"key: value\" lines, indented below it)");
  for (const auto& item : value.node()) {
    const int line = line_of(item.first, value.line());
    const YamlValue here(item.second, value.source(), value.what(), line);
    if (!item.first.IsScalar()) here.refuse("a key is not a name (write \"key: value\")");
    const std::string& key = item.first.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end())
      here.refuse(shown(key) + " is unknown (known: " + listed(known) + ")");
    if (has(key)) here.refuse(shown(key) + " is given twice (remove one)");
    entries_.emplace_back(key, YamlValue(item.second, value.source(), value.what() + ": " + key, line));
  }
}

bool YamlMap::has(std::string_view key) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const auto& e) { return e.first == key; });
}

YamlValue YamlMap::at(std::string_view key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e.first == key; });
  if (found == entries_.end()) value_.refuse(std::string(key) + " is missing (add it)");
  return found->second;
}

double YamlMap::number(std::string_view key, double fallback, double low, double high) const {
  return has(key) ? at(key).number(low, high) : fallback;
}

YAML::Node load_yaml(std::string_view text, const std::string& source) {
  try {
    return YAML::Load(std::string(text));
  } catch (const YAML::Exception& e) {
    throw InputError(e.mark.is_null() ? source : source + ":" + std::to_string(e.mark.line + 1),
                     "broken YAML: " + e.msg + " (fix the line)");
  }
}

}  // namespace lakshya::sim
