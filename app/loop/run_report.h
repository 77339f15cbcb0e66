// What a run was like, in numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "app/loop/machinery.h"

namespace lakshya {

struct RunRecord {
  std::string source;  // the camera's driver, or the recording
  bool virtual_clock = false;
  Nanoseconds start = 0;
  Nanoseconds end = 0;
  double wall_s = 0;             // on the machine's clock
  std::vector<StateNote> notes;  // changes of state, in order; the first kMostNotes
  std::uint64_t notes_left_out = 0;
  static constexpr std::size_t kMostNotes = 1000;
};

nlohmann::ordered_json run_report(const Machinery& machinery, const Exchange& exchange, const RunRecord& record);

// The report's figures for people.
std::string report_text(const nlohmann::ordered_json& report);

}  // namespace lakshya
