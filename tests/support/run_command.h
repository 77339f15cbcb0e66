// For tests of the built command, as a user starts it.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace lakshya {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// The host command that LAKSHYA_BIN names; empty when there is none.
inline std::string lakshya_binary() {
  const char* binary = std::getenv("LAKSHYA_BIN");
  return binary != nullptr && std::filesystem::exists(binary) ? binary : "";
}

inline std::string bytes_of(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

inline std::string quoted_for_shell(const std::string& word) {
  std::string out = "'";
  for (const char c : word)
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// Program and arguments, each as it is: nothing is expanded.
inline Outcome run_command(const std::vector<std::string>& words) {
  const TempFolder folder;
  std::string command;
  for (const std::string& word : words)
    command += quoted_for_shell(word) + " ";
  Outcome outcome;
  FILE* pipe = popen((command + "2>" + quoted_for_shell(folder.path("err"))).c_str(), "r");
  if (pipe == nullptr) return outcome;
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe))
    outcome.out.append(buffer, got);
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.err = bytes_of(folder.path("err"));
  return outcome;
}

// The host command with words that have no spaces in them, as one types them.
inline Outcome run_lakshya(const std::string& arguments) {
  std::vector<std::string> words{lakshya_binary()};
  std::istringstream in(arguments);
  for (std::string word; in >> word;)
    words.push_back(word);
  return run_command(words);
}

}  // namespace lakshya
