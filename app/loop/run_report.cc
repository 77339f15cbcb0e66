#include "app/loop/run_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "app/loop/memory_watch.h"
#include "app/loop/real_time.h"

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

double milliseconds(Nanoseconds t) {
  return rounded(static_cast<double>(t) / 1e6);
}

double seconds(Nanoseconds t) {
  return rounded(static_cast<double>(t) / 1e9);
}

Json times(const TimeHistogram& h) {
  return {{"p50", milliseconds(h.quantile(500))},
          {"p99", milliseconds(h.quantile(990))},
          {"max", milliseconds(h.max())}};
}

Json stages(const StageTimes& t) {
  Json json;
  json["frame"] = times(t.frame());
  for (int i = 0; i < kStages; ++i)
    json[to_string(static_cast<Stage>(i))] = times(t.of(static_cast<Stage>(i)));
  return json;
}

Json counters(const Device* device) {
  Json json = Json::object();
  if (device == nullptr) return json;
  for (const Counter& counter : device->counters())
    json[counter.name] = counter.value;
  return json;
}

Json faults(const ControlCounts& counts) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kEvents; ++i) {
    const auto event = static_cast<Event>(i);
    if (kind_of(event) != Kind::course && counts.faults[i] > 0) json[to_string(event)] = counts.faults[i];
  }
  return json;
}

Json states(const RunRecord& record) {
  Json list = Json::array();
  list.push_back({{"time_s", 0.0}, {"state", to_string(State::init)}, {"event", ""}});
  for (const StateNote& note : record.notes) {
    if (note.from == note.to) continue;
    list.push_back({{"time_s", seconds(note.time - record.start)},
                    {"state", to_string(note.to)},
                    {"event", to_string(note.event)}});
  }
  return list;
}

// How long the vehicle was in each state.
Json state_times(const ControlCounts& counts) {
  Json json;
  for (std::size_t i = 0; i < kStates; ++i)
    json[to_string(static_cast<State>(i))] = seconds(counts.in_state[i]);
  return json;
}

}  // namespace

Json run_report(const Machinery& m, const Exchange& x, const RunRecord& record) {
  const ControlCounts& counts = m.control().counts();
  const StageTimes& stage_times = m.pipeline().times();
  Json json;
  json["source"] = record.source;
  json["clock"] = record.virtual_clock ? "virtual" : "real";
  json["duration_s"] = seconds(record.end - record.start);
  json["wall_s"] = rounded(record.wall_s);
  json["frames"] = stage_times.frame().count();
  json["dropped"] = x.dropped.load();
  json["overruns"] = counts.overruns;
  json["stages_ms"] = stages(stage_times);
  json["control"] = {{"turns", counts.turns},
                     {"plans", m.control().plans()},
                     {"lateness_ms", times(counts.lateness)},
                     {"took_ms", times(counts.took)}};
  json["arena_bytes"] = m.arena_bytes();
  json["rss_bytes"] = resident_bytes();
  json["rss_peak_bytes"] = most_resident_bytes();
  if (allocations_are_counted() && memory_was_watched()) {
    json["allocations_after_ready"] = allocations_at(WatchedPlace::loop);
    json["allocations_decoding"] = allocations_at(WatchedPlace::decoding);
  } else {
    json["allocations_after_ready"] = nullptr;  // nobody counted, or it was never READY
  }
  json["page_faults_after_ready"] = page_faults_at(WatchedPlace::loop);
  json["faults"] = faults(counts);
  json["states"] = states(record);
  json["state_s"] = state_times(counts);
  json["states_left_out"] = record.notes_left_out;
  json["lost_log_lines"] = x.notes.lost();
  json["lost_decisions"] = x.decisions.lost();
  json["devices"] = {{"camera", counters(m.devices().camera.device.get())},
                     {"servo", counters(m.devices().servo.device.get())},
                     {"compass", counters(m.devices().compass.device.get())},
                     {"estop", counters(m.devices().estop.device.get())}};
  return json;
}

std::string report_text(const Json& r) {
  std::string text =
      fmt::format("{} frames in {:.1f} s ({} clock, {:.1f} s on the machine's), {} dropped, {} overruns\n",
                  r["frames"].get<std::uint64_t>(), r["duration_s"].get<double>(), r["clock"].get<std::string>(),
                  r["wall_s"].get<double>(), r["dropped"].get<std::uint64_t>(), r["overruns"].get<std::uint64_t>());
  text += fmt::format("  {:<18}{:>9}{:>9}{:>9}  ms\n", "", "p50", "p99", "max");
  const auto line = [&](const std::string& name, const Json& t) {
    text += fmt::format("  {:<18}{:>9.2f}{:>9.2f}{:>9.2f}\n", name, t["p50"].get<double>(), t["p99"].get<double>(),
                        t["max"].get<double>());
  };
  for (const auto& [name, value] : r["stages_ms"].items())
    line(name, value);
  line("control turn", r["control"]["took_ms"]);
  line("control late by", r["control"]["lateness_ms"]);
  text += fmt::format("memory: arena {:.1f} MB, resident {:.1f} MB", r["arena_bytes"].get<double>() / 1e6,
                      r["rss_bytes"].get<double>() / 1e6);
  if (!r["allocations_after_ready"].is_null())
    text += fmt::format(", {} allocations after READY", r["allocations_after_ready"].get<std::uint64_t>());
  text += "\nstates:";
  for (const auto& [name, value] : r["state_s"].items()) {
    if (value.get<double>() > 0) text += fmt::format(" {} {:.1f} s", name, value.get<double>());
  }
  text += "\nfaults:";
  for (const auto& [name, value] : r["faults"].items())
    text += fmt::format(" {} {}", name, value.get<std::uint64_t>());
  text += r["faults"].empty() ? " none\n" : "\n";
  return text;
}

}  // namespace lakshya
