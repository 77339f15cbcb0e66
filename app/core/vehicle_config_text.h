// Writes the configuration and its list of keys as text: boards/host/vehicle.yaml, the effective values and the
// table of docs/configuration.md.
#pragma once

#include <string>

#include "app/core/vehicle_config.h"
#include "app/core/vehicle_config_keys.h"

namespace lakshya {

// Every key with its built-in default, unit, range and meaning, and the built-in profiles:
// boards/host/vehicle.yaml.
std::string documented_yaml();

// The same form with the values of `config`; its profile is empty, since it is merged into them. Loading the text
// with no other option gives `config` again, bit for bit.
std::string effective_yaml(const VehicleConfig& config);

// One Markdown table: key, default with the profiles' values, allowed values with unit, meaning.
std::string markdown_table();

// Shortest decimal text, without exponent, that reads back as the same number: "0.6", "20".
std::string number_text(double value);

// "0.05 .. 5 m", "16 .. 512 px in steps of 16", "3 or 5"; names: "stop or slow";
// "text".
std::string allowed_text(const Range& range, std::string_view unit);
std::string allowed_text(Names names, std::string_view unit);
std::string allowed_text(const Text& text, std::string_view unit);

}  // namespace lakshya
