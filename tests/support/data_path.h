// For tests that look at real data, where the machine has them (CONTRIBUTING.md, "Tests").
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace lakshya::test {

// A file or folder below the folder that LAKSHYA_DATA names; empty where there is none.
inline std::string data_path(const std::string& name) {
  const char* folder = std::getenv("LAKSHYA_DATA");
  if (folder == nullptr) return {};
  const std::string path = std::string(folder) + "/" + name;
  return std::filesystem::exists(path) ? path : std::string();
}

}  // namespace lakshya::test
