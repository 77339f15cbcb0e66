#include "app/core/vehicle_config_setting.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_keys.h"
#include "app/core/vehicle_config_text.h"

namespace lakshya {
namespace {

// Levenshtein: the least number of inserted, removed and replaced characters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string_view without_group(std::string_view key) {
  return key.substr(key.find('.') + 1);
}

// A right name in the wrong group, or without one, is nearer than any misspelt key.
std::size_t name_distance(std::string_view text, std::string_view known) {
  if (without_group(text) == without_group(known)) return 1;
  return edit_distance(text, known);
}

std::optional<std::string_view> nearest(std::string_view text, const std::vector<std::string_view>& known) {
  constexpr std::size_t kLongest = 64;  // a longer text is no misspelling
  if (text.size() > kLongest || known.empty()) return std::nullopt;
  const auto best = std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
    return name_distance(text, a) < name_distance(text, b);
  });
  const std::size_t accepted = std::max<std::size_t>(2, without_group(text).size() / 3);
  return name_distance(text, *best) <= accepted ? std::optional(*best) : std::nullopt;
}

template <class T>
bool parse_number(std::string_view text, T& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ptr == text.data() + text.size() && result.ec != std::errc::invalid_argument;
}

bool inside(double value, const Range& range) {
  if (value < range.min || value > range.max) return false;
  if (range.step <= 0) return true;
  const double steps = (value - range.min) / range.step;
  return std::abs(steps - std::round(steps)) < 1e-6;
}

class SettingVisitor {
 public:
  explicit SettingVisitor(const Setting& setting) : setting_(setting) {}

  void operator()(const Key& key, double& field, const Range& range) {
    if (!matches(key)) return;
    double value = NAN;  // what a number too large or too small for a double leaves
    if (setting_.quoted || !parse_number(setting_.text, value)) refuse(key, "is not a number", range);
    if (!std::isfinite(value)) refuse(key, "is not a finite number", range);
    if (!inside(value, range)) refuse(key, "is out of range", range);
    field = value;
  }

  void operator()(const Key& key, int& field, const Range& range) {
    if (!matches(key)) return;
    long long value = std::numeric_limits<long long>::max();  // what a number too large for it leaves
    if (setting_.quoted || !parse_number(setting_.text, value)) refuse(key, "is not a whole number", range);
    if (!inside(static_cast<double>(value), range)) refuse(key, "is out of range", range);
    field = static_cast<int>(value);
  }

  void operator()(const Key& key, std::string& field, Names names) {
    if (!matches(key)) return;
    if (std::find(names.begin(), names.end(), setting_.text) == names.end()) refuse(key, "is not known", names);
    field = setting_.text;
  }

  void operator()(const Key& key, std::string& field, const Text& text) {
    if (!matches(key)) return;
    const auto forbidden = [](char c) {
      const auto u = static_cast<unsigned char>(c);
      return u < 0x20 || u == 0x7f || c == '"' || c == '\\';
    };
    const std::string& value = setting_.text;
    if (value.size() > text.longest || std::any_of(value.begin(), value.end(), forbidden))
      refuse(key, "cannot be taken", text);
    field = value;
  }

  bool found() const { return found_; }

 private:
  bool matches(const Key& key) {
    if (setting_.key != key.name) return false;
    found_ = true;
    return true;
  }

  template <class Allowed>
  [[noreturn]] void refuse(const Key& key, const char* reason, const Allowed& allowed) const {
    throw InputError(setting_.where, setting_.key + ": " + quote(setting_.text) + " " + reason +
                                         " (allowed: " + allowed_text(allowed, key.unit) + ")");
  }

  const Setting& setting_;
  bool found_ = false;
};

}  // namespace

void apply(const Setting& setting, VehicleConfig& config) {
  SettingVisitor visitor(setting);
  visit_keys(config, visitor);
  if (visitor.found()) return;
  const std::string hint = did_you_mean(setting.key, key_names());
  throw InputError(setting.where, quote(setting.key) + ": unknown key (" +
                                      (hint.empty() ? "`lakshya config` lists all keys" : hint) + ")");
}

Setting parse_set(const std::string& text) {
  const std::string where = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(where, "not of the form key=value (for example --set camera.height_m=0.45)");
  }
  Setting setting{text.substr(0, equals), text.substr(equals + 1), where};
  if (setting.key == "profile") throw InputError(where, "profile: not a key (use --profile)");
  return setting;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string shown(text.substr(0, kLongest));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return "\"" + shown + (text.size() > kLongest ? "...\"" : "\"");
}

std::vector<std::string_view> key_names() {
  std::vector<std::string_view> names;
  const VehicleConfig config;
  visit_keys(config, [&](const Key& key, const auto&, const auto&) { names.push_back(key.name); });
  return names;
}

std::string did_you_mean(std::string_view text, const std::vector<std::string_view>& known) {
  const auto near = nearest(text, known);
  return near ? "did you mean " + std::string(*near) + "?" : std::string();
}

}  // namespace lakshya
