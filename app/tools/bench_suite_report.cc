// Table and JSON of `./dev bench`.
#include <algorithm>
#include <sstream>

#include "app/tools/bench_report.h"
#include "app/tools/bench_suite.h"

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kScaledRows[] = {"sad", "census", "sgm", "frame"};

std::string size_text(const BenchResult& r) {
  return std::to_string(r.width) + "x" + std::to_string(r.height);
}

// "1.23 (4.5x)"
std::string cell(const BenchResult& result, const std::string& name) {
  for (const BenchRow& row : result.rows) {
    if (row.name != name) continue;
    const std::optional<double> speedup = row.speedup();
    return milliseconds(row.ms) + (speedup ? " (" + decimal(*speedup, *speedup < 1 ? 2 : 1) + "x)" : "");
  }
  return "-";
}

void add_settings(std::ostream& out, const SuiteResults& results) {
  out << "Milliseconds, in brackets how many times as long OpenCV takes; medians, ours and OpenCV's in turns.\n\n"
      << "| images | disparities | threads | kernels |";
  for (const char* row : kBenchRows)
    out << " " << row << " |";
  out << "\n|---|---|---|---|";
  for (std::size_t i = 0; i < kBenchRows.size(); ++i)
    out << "---|";
  out << "\n";
  for (const BenchResult& r : results.settings) {
    out << "| " << size_text(r) << " | " << r.disparities << " | " << r.threads << " | " << r.isa << " |";
    for (const char* row : kBenchRows)
      out << " " << cell(r, row) << " |";
    out << "\n";
  }
}

void add_target(std::ostream& out, const SuiteResults& results) {
  out << "\nRaw pair to command, target " << kTargetMs << " ms:";
  for (const BenchResult& r : results.target) {
    const double ms = r.rows.front().ms;
    out << " " << size_text(r) << ", " << r.disparities << " disparities, " << r.threads << " threads, " << r.isa
        << ": " << milliseconds(ms) << " ms (" << (ms < kTargetMs ? "met" : "missed") << ");";
  }
  out << "\n";
}

void add_reference(std::ostream& out, const SuiteResults& results) {
  const BenchResult& first = results.settings.front();
  out << "\nScalar reference, " << size_text(first) << ", " << first.disparities << " disparities, "
      << first.threads << " thread, and how many times as long as " << first.isa << " it takes:";
  for (const BenchRow& row : first.rows) {
    if (row.reference_ms && row.name != "sgm_vs_bm") {
      out << " " << row.name << " " << milliseconds(*row.reference_ms) << " ms ("
          << decimal(*row.reference_ms / row.ms, 1) << "x);";
    }
  }
  out << "\n";
}

void add_scaling(std::ostream& out, const SuiteResults& results) {
  out << "\nTime against pixels x disparities over " << results.scaling.size() << " sizes, one thread, "
      << results.scaling.front().isa << ":";
  for (const char* row : kScaledRows) {
    const LineFit fit = fit_line(scaling_points(results.scaling, row));
    out << " " << row << " " << decimal(fit.slope, 3) << " ns per pixel-disparity (R2 " << decimal(fit.r2, 4)
        << ");";
  }
  out << "\n";
}

void add_kernels(std::ostream& out, const SuiteResults& results) {
  out << "\n| kernels | kernel | ms per frame | operations per item | item | 10^9 operations/s | % of peak |\n"
      << "|---|---|---|---|---|---|---|\n";
  for (const KernelTime& k : results.kernels) {
    const auto peak = std::find_if(results.peaks.begin(), results.peaks.end(),
                                   [&](const MachinePeak& p) { return p.isa == k.isa; });
    out << "| " << k.isa << " | " << k.work.name << " | " << milliseconds(k.ms) << " | "
        << decimal(k.work.operations, 0) << " | " << (k.work.per_disparity ? "pixel-disparity" : "pixel") << " | "
        << decimal(k.operations_per_s() * 1e-9, 1) << " | "
        << decimal(100 * k.operations_per_s() / peak->operations_per_s, 1) << " |\n";
  }
  out << "\nPeak of one core:";
  for (const MachinePeak& p : results.peaks) {
    out << " " << p.isa << " " << decimal(p.operations_per_s * 1e-9, 0)
        << " 10^9 operations/s on bytes, second-level cache " << decimal(p.l2_bytes_per_s * 1e-9, 0)
        << " GB/s, memory " << decimal(p.memory_bytes_per_s * 1e-9, 0) << " GB/s;";
  }
  out << "\n";
}

Json kernel_json(const KernelTime& k) {
  return {{"isa", k.isa},
          {"kernel", k.work.name},
          {"ms", k.ms},
          {"item", k.work.per_disparity ? "pixel-disparity" : "pixel"},
          {"operations_per_item", k.work.operations},
          {"bytes_per_item", k.work.bytes},
          {"operations_per_s", k.operations_per_s()}};
}

Json results_json(const std::vector<BenchResult>& results) {
  Json all = Json::array();
  for (const BenchResult& r : results)
    all.push_back(bench_json(r));
  return all;
}

}  // namespace

std::string suite_markdown(const SuiteResults& results) {
  std::ostringstream out;
  out << "Machine: " << results.processor << ". Input: " << results.input << ".\n\n";
  add_settings(out, results);
  add_target(out, results);
  add_reference(out, results);
  add_scaling(out, results);
  add_kernels(out, results);
  out << "\n" << opencv_build_text(opencv_build());
  return out.str();
}

std::string suite_json(const SuiteResults& results) {
  Json all;
  all["processor"] = results.processor;
  all["input"] = results.input;
  all["opencv"] = opencv_build_json(opencv_build());
  all["settings"] = results_json(results.settings);
  all["target"] = {{"ms", kTargetMs}, {"results", results_json(results.target)}};
  all["scaling"] = {{"results", results_json(results.scaling)}, {"fits", Json::array()}};
  for (const char* row : kScaledRows) {
    const LineFit fit = fit_line(scaling_points(results.scaling, row));
    all["scaling"]["fits"].push_back(
        {{"name", row}, {"ns_per_pixel_disparity", fit.slope}, {"intercept_ms", fit.intercept}, {"r2", fit.r2}});
  }
  all["kernels"] = Json::array();
  for (const KernelTime& k : results.kernels)
    all["kernels"].push_back(kernel_json(k));
  all["peaks"] = Json::array();
  for (const MachinePeak& p : results.peaks) {
    all["peaks"].push_back({{"isa", p.isa},
                            {"operations_per_s", p.operations_per_s},
                            {"l2_bytes_per_s", p.l2_bytes_per_s},
                            {"memory_bytes_per_s", p.memory_bytes_per_s}});
  }
  return all.dump(1) + "\n";
}

}  // namespace lakshya
