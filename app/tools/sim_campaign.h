// Many simulated drives, each in a process of its own, several at a time: a crash in one ends that one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/tools/sim/run_result.h"

namespace lakshya {

struct CampaignSettings {
  std::vector<std::uint64_t> seeds;
  int jobs = 1;
  // A file of lines as run_json() writes them: drives that are in it are not driven again, new ones are added at once, so that a
  // campaign that was interrupted goes on where it was. Empty: none.
  std::string results;
};

// Runs `drive(seed)` for every seed, in child processes, and gives the results in the order of the seeds. Call it before this
// process has threads. `progress(done, newest)` is called after each. Throws InputError: a results file that is none, or of other
// worlds or another sensor; a drive that threw or crashed (with its message).
std::vector<sim::RunResult> run_campaign(
    const CampaignSettings& settings, const std::string& world, const std::string& sensor,
    const std::function<sim::RunResult(std::uint64_t seed)>& drive,
    const std::function<void(std::size_t done, const sim::RunResult& newest)>& progress);

}  // namespace lakshya
