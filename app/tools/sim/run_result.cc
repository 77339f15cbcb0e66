#include "app/tools/sim/run_result.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace lakshya::sim {
namespace {

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

nlohmann::ordered_json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

std::string text_of(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::string() : json.get<std::string>();
}

double mean(double sum, std::size_t count) {
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

}  // namespace

nlohmann::ordered_json run_json(const RunResult& r) {
  return {{"world", r.world},
          {"seed", r.seed},
          {"sensor", r.sensor},
          {"result", kEndingNames[static_cast<std::size_t>(r.ending)]},
          {"hit", text_or_null(r.hit)},
          {"hit_kind", text_or_null(r.hit_kind)},
          {"excuse", text_or_null(r.excuse)},
          {"time_s", rounded(r.time_s)},
          {"path_m", rounded(r.path_m)},
          {"shortest_m", rounded(r.shortest_m)},
          {"min_clearance_m", rounded(r.min_clearance_m)},
          {"mean_speed", rounded(r.mean_speed_mps)},
          {"false_stops", r.false_stops},
          {"bumps", r.bumps},
          {"frames", r.frames},
          {"frame_ms_p50", rounded(r.frame_ms_p50)},
          {"frame_ms_p99", rounded(r.frame_ms_p99)},
          {"goal_distance_m", rounded(r.goal_distance_m)}};
}

RunResult run_from_json(const nlohmann::ordered_json& json) {
  try {
    RunResult r;
    r.world = json.at("world").get<std::string>();
    r.seed = json.at("seed").get<std::uint64_t>();
    r.sensor = json.at("sensor").get<std::string>();
    const auto name = std::ranges::find(kEndingNames, json.at("result").get<std::string>());
    if (name == kEndingNames.end()) throw std::invalid_argument("no such result");
    r.ending = static_cast<Ending>(name - kEndingNames.begin());
    r.hit = text_of(json.at("hit"));
    r.hit_kind = text_of(json.at("hit_kind"));
    r.excuse = text_of(json.at("excuse"));
    r.time_s = json.at("time_s").get<double>();
    r.path_m = json.at("path_m").get<double>();
    // An infinite length is written as null: the goal cannot be reached at all.
    const auto& shortest = json.at("shortest_m");
    r.shortest_m = shortest.is_null() ? HUGE_VAL : shortest.get<double>();
    r.min_clearance_m = json.at("min_clearance_m").is_null() ? HUGE_VAL : json.at("min_clearance_m").get<double>();
    r.mean_speed_mps = json.at("mean_speed").get<double>();
    r.false_stops = json.at("false_stops").get<std::uint64_t>();
    r.bumps = json.at("bumps").get<std::uint64_t>();
    r.frames = json.at("frames").get<std::uint64_t>();
    r.frame_ms_p50 = json.at("frame_ms_p50").get<double>();
    r.frame_ms_p99 = json.at("frame_ms_p99").get<double>();
    r.goal_distance_m = json.at("goal_distance_m").get<double>();
    return r;
  } catch (const nlohmann::json::exception& e) {
    throw std::invalid_argument(e.what());
  }
}

nlohmann::ordered_json summary_json(const std::vector<RunResult>& results) {
  std::map<std::string, int> hits;
  std::map<std::string, int> excused;
  std::array<int, kEndingNames.size()> endings{};
  int collisions = 0;
  std::uint64_t false_stops = 0;
  double detour = 0;
  double speed = 0;
  std::vector<double> p50;
  double p99 = 0;
  double least_clearance = HUGE_VAL;
  for (const RunResult& r : results) {
    ++endings[static_cast<std::size_t>(r.ending)];
    if (r.is_collision()) ++collisions;
    if (!r.hit_kind.empty()) ++(r.excuse.empty() ? hits[r.hit_kind] : excused[r.excuse]);
    false_stops += r.false_stops;
    p50.push_back(r.frame_ms_p50);
    p99 = std::max(p99, r.frame_ms_p99);
    least_clearance = std::min(least_clearance, r.min_clearance_m);
    if (r.ending != Ending::reached) continue;
    detour += r.path_m / r.shortest_m;
    speed += r.mean_speed_mps;
  }
  const auto reached = static_cast<std::size_t>(endings[0]);
  std::ranges::sort(p50);
  return {{"summary", true},
          {"runs", results.size()},
          {"reached", endings[0]},
          {"collisions", collisions},
          {"excused", excused},
          {"dropoffs", endings[2]},
          {"stuck", endings[3]},
          {"timeouts", endings[4]},
          {"hits", hits},
          {"false_stops", false_stops},
          {"min_clearance_m", rounded(least_clearance)},
          {"path_over_shortest", rounded(mean(detour, reached))},
          {"mean_speed", rounded(mean(speed, reached))},
          {"frame_ms_p50", p50.empty() ? 0 : rounded(p50[p50.size() / 2])},
          {"frame_ms_p99", rounded(p99)}};
}

}  // namespace lakshya::sim
