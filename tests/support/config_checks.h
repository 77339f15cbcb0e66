// For the tests of the configuration: what a load says, and equality of configurations.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"

namespace lakshya {

// The message of the InputError, or "accepted".
template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

inline std::string set_refusal(const std::string& set) {
  return refusal([&] { load_vehicle_config("", "", {set}); });
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(message, part)) << message << "\nlacks: " << part;
}

// Same values: the text has every value in full precision.
inline void expect_same(const VehicleConfig& a, const VehicleConfig& b) {
  EXPECT_EQ(effective_yaml(a), effective_yaml(b));
}

// A file of the source tree that LAKSHYA_ROOT names; empty when it is not there.
inline std::string source_file(const char* name) {
  const char* root = std::getenv("LAKSHYA_ROOT");
  if (root == nullptr) return {};
  std::ifstream in(std::filesystem::path(root) / name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace lakshya
