#include "app/tools/bench_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/core.hpp>
#include <sstream>

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(const std::optional<double>& value, double unit) {
  return value ? Json(std::round(*value / unit) * unit) : Json(nullptr);
}

// What follows "NAME:" in cv::getBuildInformation().
std::string build_line(const std::string& information, const std::string& name) {
  std::istringstream lines(information);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(name + ":");
    if (at == std::string::npos) continue;
    const std::size_t text = line.find_first_not_of(' ', at + name.size() + 1);
    return text == std::string::npos ? "" : line.substr(text);
  }
  return "not said";
}

}  // namespace

std::string milliseconds(double ms) {
  const int places = ms >= 100 ? 0 : ms >= 10 ? 1 : ms >= 1 ? 2 : 3;
  std::ostringstream out;
  out << std::fixed << std::setprecision(places) << ms;
  return out.str();
}

Json bench_json(const BenchResult& r) {
  constexpr double kMicrosecond = 1e-3;
  Json rows = Json::array();
  for (const BenchRow& row : r.rows) {
    rows.push_back({{"name", row.name},
                    {"ms", rounded(row.ms, kMicrosecond)},
                    {"ref_ms", rounded(row.reference_ms, kMicrosecond)},
                    {"peer", row.peer.empty() ? Json(nullptr) : Json(row.peer)},
                    {"peer_ms", rounded(row.peer_ms, kMicrosecond)},
                    {"speedup", rounded(row.speedup(), 1e-3)}});
  }
  return {{"isa", r.isa},
          {"width", r.width},
          {"height", r.height},
          {"disparities", r.disparities},
          {"threads", r.threads},
          {"backend", r.backend},
          {"bands", r.bands},
          {"density", rounded(r.density, 1e-4)},
          {"obstacle_share", rounded(r.obstacle_share, 1e-4)},
          {"floor_share", rounded(r.floor_share, 1e-4)},
          {"rows", rows}};
}

std::string bench_text(const BenchResult& r) {
  std::ostringstream out;
  const auto percent = [](double share) { return std::lround(100 * share); };
  out << r.width << "x" << r.height << ", " << r.disparities << " disparities, " << r.threads
      << (r.threads == 1 ? " thread, " : " threads, ") << r.backend << " kernels on " << r.isa << ", " << r.bands
      << " bands; disparity at " << percent(r.density) << " % of the pixels, obstacle " << percent(r.obstacle_share)
      << " %, floor " << percent(r.floor_share) << " %\n"
      << std::left << std::setw(16) << "row" << std::right << std::setw(10) << "ms" << std::setw(10) << "ref ms"
      << std::setw(10) << "peer ms" << std::setw(10) << "speed-up"
      << "  peer\n";
  for (const BenchRow& row : r.rows) {
    const auto number = [](const std::optional<double>& ms) { return ms ? milliseconds(*ms) : std::string("-"); };
    out << std::left << std::setw(16) << row.name << std::right << std::setw(10) << milliseconds(row.ms)
        << std::setw(10) << number(row.reference_ms) << std::setw(10) << number(row.peer_ms) << std::setw(10)
        << number(row.speedup()) << "  " << row.peer << "\n";
  }
  return out.str();
}

OpencvBuild opencv_build() {
  const std::string& information = cv::getBuildInformation();
  return {CV_VERSION, build_line(information, "Baseline"), build_line(information, "Dispatched code generation"),
          build_line(information, "Parallel framework"), cv::getCPUFeaturesLine()};
}

Json opencv_build_json(const OpencvBuild& b) {
  return {{"version", b.version},
          {"baseline", b.baseline},
          {"dispatched", b.dispatched},
          {"parallel", b.parallel},
          {"processor", b.processor}};
}

std::string opencv_build_text(const OpencvBuild& b) {
  return "OpenCV " + b.version + ": baseline " + b.baseline + "; dispatched, in some files, " + b.dispatched +
         "; threads: " + b.parallel + "; here: " + b.processor + "\n";
}

}  // namespace lakshya
