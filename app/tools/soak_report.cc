#include "app/tools/soak_report.h"

#include <spdlog/fmt/fmt.h>

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

double milliseconds(Nanoseconds t) {
  return static_cast<double>(t) / 1e6;
}

double seconds(Nanoseconds t) {
  return static_cast<double>(t) / 1e9;
}

Json record_json(FaultKind kind, const FaultRecord& r) {
  return {{"fault", to_string(kind)},
          {"times", r.times},
          {"while_turning", r.while_turning},
          {"stopped", r.stopped},
          {"worst_reaction_ms", milliseconds(r.worst_reaction)},
          {"recovered", r.recovered},
          {"worst_recovery_s", seconds(r.worst_recovery)}};
}

Json sample_json(const SoakSample& s) {
  return {{"frames", s.frames},
          {"time_s", seconds(s.time)},
          {"faults", s.faults},
          {"resident_bytes", s.resident_bytes},
          {"handles", s.handles},
          {"p50_ms", milliseconds(s.p50)},
          {"p99_ms", milliseconds(s.p99)},
          {"allocations", s.allocations}};
}

std::string growth_text(const SoakResult& r) {
  const SoakGrowth g = soak_growth(r);
  std::string text = fmt::format("{:<34} {:>12} {:>12}\n", "", "second fifth", "last fifth");
  text += fmt::format("{:<34} {:>12.2f} {:>12.2f}\n", "resident memory, mean [MB]", g.resident_before / 1e6,
                      g.resident_after / 1e6);
  text += fmt::format("{:<34} {:>12} {:>12}\n", "open handles, most", g.handles_before, g.handles_after);
  text += fmt::format("{:<34} {:>12.2f} {:>12.2f}\n", "frame (perception), median [ms]", g.p50_before_ms,
                      g.p50_after_ms);
  std::uint64_t allocations = 0;
  for (const SoakSample& s : r.samples)
    allocations += s.allocations;
  text += r.allocations_are_counted ? fmt::format("allocations of the loop after READY: {}\n", allocations)
                                    : "allocations of the loop: not counted in this program\n";
  return text;
}

}  // namespace

std::string fault_table(const SoakResult& result) {
  std::string text = fmt::format("{:<15} {:>6} {:>9} {:>8} {:>10} {:>9} {:>10} {:>10} {:>9}\n", "fault", "times",
                                 "driving", "stopped", "worst [ms]", "limit", "recovered", "worst [s]", "limit");
  for (std::size_t i = 0; i < kFaultKinds; ++i) {
    const FaultRecord& r = result.records[i];
    text += fmt::format("{:<15} {:>6} {:>9} {:>8} {:>10} {:>9.0f} {:>10} {:>10} {:>9.2f}\n",
                        to_string(static_cast<FaultKind>(i)), r.times, r.while_turning, r.stopped,
                        r.stopped > 0 ? fmt::format("{:.0f}", milliseconds(r.worst_reaction)) : "-",
                        milliseconds(result.limits.reaction), r.recovered,
                        r.recovered > 0 ? fmt::format("{:.2f}", seconds(r.worst_recovery)) : "-",
                        seconds(result.limits.recovery));
  }
  return text;
}

std::string soak_text(const SoakResult& r) {
  std::string text = fmt::format(
      "{} frames of {} ({} pairs of {}x{}, seed {}): {:.0f} s of virtual time, {} control turns, {} faults, in "
      "{:.0f} s\n\n",
      r.frames, r.settings.source, r.pairs, r.width, r.height, r.settings.seed, seconds(r.virtual_time), r.turns,
      r.faults, r.wall_s);
  text += fault_table(r) + "\n" + growth_text(r) + "\n";
  for (const SoakViolation& v : r.first_violations)
    text += violation_text(v, r.start) + "\n";
  const SoakVerdict verdict = soak_verdict(r);
  for (const std::string& warning : verdict.warnings)
    text += "warning: " + warning + "\n";
  for (const std::string& failure : verdict.failures)
    text += "FAILED: " + failure + "\n";
  if (verdict.failures.empty()) text += "soak: passed\n";
  return text;
}

Json soak_json(const SoakResult& r) {
  const SoakGrowth g = soak_growth(r);
  const SoakVerdict verdict = soak_verdict(r);
  Json json = {{"source", r.settings.source},
               {"seed", r.settings.seed},
               {"frames", r.frames},
               {"pairs", r.pairs},
               {"width", r.width},
               {"height", r.height},
               {"virtual_s", seconds(r.virtual_time)},
               {"wall_s", r.wall_s},
               {"turns", r.turns},
               {"limits",
                {{"reaction_ms", milliseconds(r.limits.reaction)},
                 {"recovery_s", seconds(r.limits.recovery)},
                 {"frozen_travel_m", r.limits.frozen_travel_m}}},
               {"passed", verdict.failures.empty()},
               {"failures", verdict.failures},
               {"warnings", verdict.warnings},
               {"growth",
                {{"resident_bytes", {g.resident_before, g.resident_after}},
                 {"handles", {g.handles_before, g.handles_after}},
                 {"p50_ms", {g.p50_before_ms, g.p50_after_ms}}}},
               {"allocations_are_counted", r.allocations_are_counted},
               {"violations", r.violations}};
  json["first_violations"] = Json::array();
  for (const SoakViolation& v : r.first_violations)
    json["first_violations"].push_back(violation_text(v, r.start));
  json["faults"] = Json::array();
  for (std::size_t i = 0; i < kFaultKinds; ++i)
    json["faults"].push_back(record_json(static_cast<FaultKind>(i), r.records[i]));
  json["samples"] = Json::array();
  for (const SoakSample& s : r.samples)
    json["samples"].push_back(sample_json(s));
  return json;
}

}  // namespace lakshya
