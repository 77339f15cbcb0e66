// All settings of `./dev bench` as one run, and what it writes.
#pragma once

#include <string>
#include <vector>

#include "app/tools/bench_kernels.h"
#include "app/tools/bench_setting.h"
#include "app/tools/picture_canvas.h"

namespace lakshya {

struct SuiteOptions {
  bool quick = false;  // small images and few runs: to see that it works
  BenchPair pair;
  std::vector<std::string> sets;
};

struct SuiteResults {
  std::string processor;
  std::string input;                  // what was measured on
  std::vector<BenchResult> settings;  // sizes x disparities x threads x instruction sets
  std::vector<BenchResult> target;    // the frame that has to be done in kTargetMs, per instruction set
  std::vector<BenchResult> scaling;   // growing images, one thread
  std::vector<KernelTime> kernels;    // per instruction set
  std::vector<MachinePeak> peaks;
};

inline constexpr double kTargetMs = 33;  // 30 frames a second, 1024x768, 64 disparities, two threads
inline constexpr int kTargetThreads = 2;

// Shows progress on stderr. Throws InputError as run_bench does.
SuiteResults run_suite(const SuiteOptions& options);

// Least squares: ms = intercept + slope * x. r2: share of the variance that the line explains.
struct LineFit {
  double intercept = 0;
  double slope = 0;
  double r2 = 0;
};
LineFit fit_line(const std::vector<Point>& points);
// x: millions of pixels x disparities, y: ms, of one row of the scaling runs.
std::vector<Point> scaling_points(const std::vector<BenchResult>& scaling, const std::string& row);

std::string suite_json(const SuiteResults& results);
std::string suite_markdown(const SuiteResults& results);
Image<Rgb8> speedup_plot(const SuiteResults& results);
Image<Rgb8> scaling_plot(const SuiteResults& results);
Image<Rgb8> roofline_plot(const SuiteResults& results);

}  // namespace lakshya
