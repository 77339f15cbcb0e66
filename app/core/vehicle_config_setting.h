// One "key = text" with its origin, and putting it into a configuration: the same for files, profiles and --set.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/core/vehicle_config.h"

namespace lakshya {

struct Setting {
  std::string key;      // "group.field"
  std::string text;     // the value as written
  std::string where;    // "file:line" or "--set key=value", for messages
  bool quoted = false;  // written as text in the file: a number must not be
};

// Throws InputError: unknown key (with the nearest known one), wrong type, not finite, outside the allowed values.
void apply(const Setting& setting, VehicleConfig& config);

// "key=value". Throws InputError.
Setting parse_set(const std::string& text);

// Input repeated in a message: in quotes, unprintable characters as '?', long text cut.
std::string quote(std::string_view text);

// The dotted names of all keys.
std::vector<std::string_view> key_names();

// "did you mean X?" when one of `known` is near to `text`, else empty.
std::string did_you_mean(std::string_view text, const std::vector<std::string_view>& known);

}  // namespace lakshya
