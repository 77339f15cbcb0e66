#include "app/core/vehicle_config_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace lakshya {
namespace {

constexpr std::string_view kHead =
    R"(# Lakshya: what the vehicle is and how it drives. A key that is left out keeps its built-in default; an unknown
# key, a value out of range and a contradiction are refused. `lakshya config` prints the values in force.
#
# SI units, angles in degrees. Body frame: x forward, y left, z up; the origin lies on the ground below the
# turning centre. The camera's angles are relative to the ground under the wheels: pitch positive nose down, roll
# positive right side down, yaw positive to the left. A value shown without a decimal point is a whole number.
#
# Profiles: a profile replaces some of the values, --profile or `profile` selects one. Of two values for one key
# the later in this list counts: built-in default (with the built-in profile of that name), a group of this file,
# the selected profile of this file, --set on the command line. More profiles may be added below.
)";

std::string value_text(double value, const Range& /*allowed*/) {
  std::string text = number_text(value);
  return text.find('.') == std::string::npos ? text + ".0" : text;
}
std::string value_text(int value, const Range& /*allowed*/) {
  return std::to_string(value);
}
std::string value_text(const std::string& value, const Names& /*allowed*/) {
  return value;
}
// In quotes, whatever it may look like.
std::string value_text(const std::string& value, const Text& /*allowed*/) {
  return "\"" + value + "\"";
}

std::pair<std::string_view, std::string_view> split_key(std::string_view name) {
  const std::size_t dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

std::string_view group_meaning(std::string_view name) {
  for (const Group& group : kGroups) {
    if (group.name == name) return group.meaning;
  }
  return {};
}

// Groups in the order of the list, each headed by its meaning, each key by its own.
class GroupWriter {
 public:
  explicit GroupWriter(std::string& text) : text_(text) {}

  template <class Field, class Allowed>
  void operator()(const Key& key, const Field& field, const Allowed& allowed) {
    const auto [group, name] = split_key(key.name);
    if (group != group_) {
      group_ = group;
      text_.append("\n# ").append(group_meaning(group)).append(".\n").append(group).append(":\n");
    }
    text_.append("  # ").append(key.meaning).append(" [").append(allowed_text(allowed, key.unit)).append("]\n");
    text_.append("  ").append(name).append(": ").append(value_text(field, allowed)).append("\n");
  }

 private:
  std::string& text_;
  std::string_view group_;
};

void append_profile(std::string& text, const Profile& profile) {
  text.append("  # ").append(profile.meaning).append(".\n  ").append(profile.name).append(":\n");
  std::string_view last_group;
  for (const Override& o : profile.overrides) {
    const auto [group, name] = split_key(o.key);
    if (group != last_group) text.append("    ").append(group).append(":\n");
    last_group = group;
    text.append("      ").append(name).append(": ").append(o.value).append("\n");
  }
}

std::string yaml_values(const VehicleConfig& config) {
  std::string text(kHead);
  text.append("\n# The profile in force unless --profile names another.\nprofile: ")
      .append(config.profile)
      .append("\n");
  visit_keys(config, GroupWriter(text));
  text.append("\nprofiles:\n");
  return text;
}

class TableWriter {
 public:
  explicit TableWriter(std::string& text) : text_(text) {}

  template <class Field, class Allowed>
  void operator()(const Key& key, const Field& field, const Allowed& allowed) {
    text_.append("| `")
        .append(key.name)
        .append("` | ")
        .append(value_text(field, allowed))
        .append(profile_values(key.name));
    text_.append(" | ").append(allowed_text(allowed, key.unit)).append(" | ").append(key.meaning).append(" |\n");
  }

 private:
  static std::string profile_values(std::string_view key) {
    std::string text;
    for (const Profile& profile : kProfiles) {
      for (const Override& o : profile.overrides) {
        if (o.key == key) text.append("; ").append(profile.name).append(" ").append(o.value);
      }
    }
    return text;
  }

  std::string& text_;
};

}  // namespace

std::string documented_yaml() {
  std::string text = yaml_values(VehicleConfig{});
  for (const Profile& profile : kProfiles)
    append_profile(text, profile);
  return text;
}

std::string effective_yaml(const VehicleConfig& config) {
  return yaml_values(config) + "  # Merged into the values above.\n  " + config.profile + ": {}\n";
}

std::string markdown_table() {
  std::string text = "| Key | Default | Allowed | Meaning |\n| --- | --- | --- | --- |\n";
  const VehicleConfig defaults;
  visit_keys(defaults, TableWriter(text));
  return text;
}

std::string number_text(double value) {
  std::array<char, 400> buffer{};  // holds every double: the longest are the smallest, about 350 characters
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), result.ptr};
}

std::string allowed_text(const Range& range, std::string_view unit) {
  const bool two_values = range.step > 0 && std::abs(range.min + range.step - range.max) < 1e-9;
  std::string text = number_text(range.min) + (two_values ? " or " : " .. ") + number_text(range.max);
  if (!unit.empty()) text.append(" ").append(unit);
  if (range.step > 0 && !two_values) text.append(" in steps of ").append(number_text(range.step));
  return text;
}

std::string allowed_text(const Text& text, std::string_view /*unit*/) {
  return "text of at most " + std::to_string(text.longest) + " characters";
}

std::string allowed_text(Names names, std::string_view /*unit*/) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text.append(i + 1 == names.size() ? " or " : ", ");
    text.append(names[i]);
  }
  return text;
}

}  // namespace lakshya
