#include "app/tools/process_report.h"

#include <iomanip>
#include <numeric>
#include <sstream>

#include "app/tools/plan_report.h"

namespace lakshya {
namespace {

constexpr std::array<const char*, kPixelClasses> kClassNames = {"no_disparity", "too_far", "drop_off",
                                                                "floor",        "ceiling", "obstacle"};
constexpr std::array<const char*, kNoDisparityReasons> kReasonNames = {
    "not_searched", "low_texture", "not_unique", "left_right_failed", "no_support", "pruned_early"};
constexpr std::array<const char*, 3> kCellNames = {"obstacle", "unoccupied", "unknown"};

double milliseconds(Nanoseconds t) {
  return static_cast<double>(t) / 1e6;
}

double total_milliseconds(const FrameResult& frame) {
  return milliseconds(std::accumulate(frame.times.took.begin(), frame.times.took.end(), Nanoseconds{0}));
}

double micro(double ms) {
  return std::round(ms * 1000) / 1000;
}

template <std::size_t N, class Counts>
nlohmann::ordered_json named(const std::array<const char*, N>& names, const Counts& counts) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < N; ++i)
    json[names[i]] = counts[i];
  return json;
}

template <std::size_t N, class Counts>
void print_counts(std::ostream& out, const char* title, const std::array<const char*, N>& names,
                  const Counts& counts) {
  const double total = std::max(1.0, std::accumulate(std::begin(counts), std::end(counts), 0.0));
  out << title << '\n';
  for (std::size_t i = 0; i < N; ++i) {
    out << "  " << std::left << std::setw(18) << names[i] << std::right << std::setw(9) << counts[i] << std::setw(7)
        << 100.0 * counts[i] / total << " %\n";
  }
}

}  // namespace

std::array<std::uint32_t, 3> count_cells(const NavGrid& grid) {
  std::array<std::uint32_t, 3> counts{};
  for (int r = 0; r < grid.geometry.rows; ++r) {
    for (int c = 0; c < grid.geometry.cols; ++c)
      ++counts[grid.type.at(c, r)];
  }
  return counts;
}

nlohmann::ordered_json frame_json(const FrameResult& frame, const PlannerParams& planner) {
  nlohmann::ordered_json json = plan_json(frame.plan, planner);
  json["width"] = frame.disparity.width;
  json["height"] = frame.disparity.height;
  json["pixels"] = named(kClassNames, frame.pixels.by_class);
  json["no_disparity"] = named(kReasonNames, frame.pixels.by_reason);
  json["cells"] = named(kCellNames, count_cells(frame.grid));
  nlohmann::ordered_json times;
  for (int i = 0; i < kStages; ++i) {
    times[to_string(static_cast<Stage>(i))] = micro(milliseconds(frame.times.took[static_cast<std::size_t>(i)]));
  }
  times["total"] = micro(total_milliseconds(frame));
  json["time_ms"] = times;
  return json;
}

std::string frame_text(const FrameResult& frame) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(1);
  print_counts(out, "pixels", kClassNames, frame.pixels.by_class);
  print_counts(out, "pixels without disparity, by reason", kReasonNames, frame.pixels.by_reason);
  print_counts(out, "map cells", kCellNames, count_cells(frame.grid));
  out << "time\n";
  for (int i = 0; i < kStages; ++i) {
    out << "  " << std::left << std::setw(18) << to_string(static_cast<Stage>(i)) << std::right << std::setw(9)
        << milliseconds(frame.times.took[static_cast<std::size_t>(i)]) << " ms\n";
  }
  out << "  " << std::left << std::setw(18) << "total" << std::right << std::setw(9) << total_milliseconds(frame)
      << " ms\n";
  out << "decision\n" << plan_command_text(frame.plan);
  return out.str();
}

}  // namespace lakshya
