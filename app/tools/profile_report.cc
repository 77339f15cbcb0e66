#include "app/tools/profile_report.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNameWidth = 22;
constexpr int kWidth = 11;
constexpr const char* kCellNames[] = {"obstacle", "unoccupied", "unknown"};

double milliseconds(Nanoseconds t) {
  return static_cast<double>(t) / 1e6;
}

double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

struct Row {
  const char* name;
  const char* of;  // the stage that it is a part of; null: a stage itself
  const TimeHistogram* times;
};

std::vector<Row> rows_of(const StageTimes& times) {
  std::vector<Row> rows{{"frame", nullptr, &times.frame()}};
  for (int i = 0; i < kStages; ++i) {
    const auto stage = static_cast<Stage>(i);
    rows.push_back({to_string(stage), nullptr, &times.of(stage)});
    if (stage != Stage::match) continue;
    for (int p = 0; p < kMatchPasses; ++p) {
      const auto pass = static_cast<MatchPass>(p);
      rows.push_back({to_string(pass), to_string(stage), &times.of(pass)});
    }
  }
  return rows;
}

double share_of(const Row& row, const StageTimes& times) {
  const auto whole = static_cast<double>(std::max<Nanoseconds>(times.frame().sum(), 1));
  return static_cast<double>(row.times->sum()) / whole;
}

double measuring_share(const ProfileReport& r) {
  const auto frame = static_cast<double>(std::max<Nanoseconds>(r.times.frame().quantile(500), 1));
  return static_cast<double>(r.measuring) / frame;
}

double mean(std::uint64_t sum, const ProfileReport& r) {
  return rounded(static_cast<double>(sum) / static_cast<double>(std::max<std::uint64_t>(r.counts.frames, 1)), 10);
}

}  // namespace

nlohmann::ordered_json profile_json(const ProfileReport& r) {
  Json json{{"isa", r.isa},
            {"backend", r.backend},
            {"matcher", r.matcher},
            {"threads", r.threads},
            {"width", r.width},
            {"height", r.height},
            {"disparities", r.disparities},
            {"frames", r.counts.frames},
            {"arena_bytes", r.arena_bytes}};
  json["stages"] = Json::array();
  for (const Row& row : rows_of(r.times)) {
    Json stage{{"stage", row.name}};
    if (row.of != nullptr) stage["of"] = row.of;
    stage["p50_ms"] = rounded(milliseconds(row.times->quantile(500)), 1e6);
    stage["p99_ms"] = rounded(milliseconds(row.times->quantile(990)), 1e6);
    stage["max_ms"] = rounded(milliseconds(row.times->max()), 1e6);
    stage["share"] = rounded(share_of(row, r.times), 1e6);
    json["stages"].push_back(std::move(stage));
  }
  json["pruning"] = Json::array();
  for (const PruningStep& step : pruning_steps(r.counts)) {
    json["pruning"].push_back(Json{{"step", step.name}, {"in", mean(step.in, r)}, {"out", mean(step.out, r)}});
  }
  for (std::size_t i = 0; i < std::size(kCellNames); ++i)
    json["cells"][kCellNames[i]] = mean(r.counts.cells[i], r);
  json["measuring"] = {{"us_per_frame", rounded(static_cast<double>(r.measuring) / 1000, 1000)},
                       {"share", rounded(measuring_share(r), 1e9)}};
  return json;
}

std::string profile_table(const ProfileReport& r) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(3);
  out << r.width << "x" << r.height << ", " << r.disparities << " disparities, matcher " << r.matcher
      << "; kernels " << r.backend << " on " << r.isa << ", " << r.threads
      << (r.threads == 1 ? " thread" : " threads") << "; " << r.counts.frames << " frames; arena "
      << std::setprecision(1) << static_cast<double>(r.arena_bytes) / (1 << 20) << " MiB\n";
  const auto name = [&](const char* text, bool is_part = false) {
    out << std::left << std::setw(kNameWidth) << (std::string(is_part ? "  " : "") + text) << std::right;
  };
  name("time");
  for (const char* column : {"p50 ms", "p99 ms", "max ms", "share"})
    out << std::setw(kWidth) << column;
  out << '\n' << std::setprecision(3);
  for (const Row& row : rows_of(r.times)) {
    name(row.name, row.of != nullptr);
    for (const Nanoseconds t : {row.times->quantile(500), row.times->quantile(990), row.times->max()})
      out << std::setw(kWidth) << milliseconds(t);
    out << std::setw(kWidth - 2) << std::setprecision(1) << 100 * share_of(row, r.times) << " %\n"
        << std::setprecision(3);
  }
  out << std::setprecision(0);
  name("pruned, mean of a frame");
  for (const char* column : {"in", "dropped", "out"})
    out << std::setw(kWidth) << column;
  out << '\n';
  for (const PruningStep& step : pruning_steps(r.counts)) {
    name(step.name);
    for (const std::uint64_t n : {step.in, step.in - step.out, step.out})
      out << std::setw(kWidth) << mean(n, r);
    out << '\n';
  }
  name("map cells");
  for (std::size_t i = 0; i < std::size(kCellNames); ++i)
    out << (i == 0 ? "  " : ", ") << mean(r.counts.cells[i], r) << ' ' << kCellNames[i];
  out << "\nmeasuring costs " << std::setprecision(2) << static_cast<double>(r.measuring) / 1000
      << " us of a frame, " << std::setprecision(4) << 100 * measuring_share(r) << " %\n";
  return out.str();
}

}  // namespace lakshya
