#include "app/tools/bench_suite.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "app/tools/progress.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

struct Size {
  int width;
  int height;
};

struct Plan {
  std::vector<Size> sizes;
  std::vector<int> disparities;
  std::vector<Size> scaling_sizes;
  int scaling_disparities;
  Size kernel_size;
  Size target_size;
  BenchRounds rounds;
  int kernel_runs;
};

Plan plan_of(bool quick) {
  if (quick) {
    return {{{320, 240}},
            {32, 64},
            {{160, 120}, {240, 180}, {320, 240}},
            32,
            {320, 240},
            {320, 240},
            {.rounds = 0, .least = 3, .most = 15, .budget_ms = 60},
            3};
  }
  return {{{640, 480}, {1280, 720}},
          {64, 128},
          {{320, 240}, {480, 360}, {640, 480}, {960, 720}, {1280, 960}},
          64,
          {640, 480},
          {1024, 768},
          {.rounds = 0, .least = 15, .most = 60, .budget_ms = 1500},
          15};
}

bool has_isa(std::string_view name) {
  const auto all = available_isas();
  return std::any_of(all.begin(), all.end(), [&](const char* isa) { return name == isa; });
}

// AVX2 first, for it is what most machines have; then the best form of AVX-512. Elsewhere all there are.
std::vector<std::string> measured_isas() {
  std::vector<std::string> isas;
  if (has_isa("avx2")) {
    isas.emplace_back("avx2");
    for (const char* isa : {"avx3_dl", "avx3"}) {
      if (isas.size() == 1 && has_isa(isa)) isas.emplace_back(isa);
    }
    return isas;
  }
  const auto all = available_isas();
  return {all.begin(), all.end()};
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

class Suite {
 public:
  explicit Suite(const SuiteOptions& options)
      : o_(options), plan_(plan_of(options.quick)), isas_(measured_isas()), progress_(steps()) {
    threads_ = {1};
    if (usable_processors() > 1) threads_.push_back(usable_processors());
  }

  SuiteResults run() {
    results_.processor = processor_name() + ", " + std::to_string(usable_processors()) + " processors";
    results_.input = o_.pair.left.empty() ? "made-up scene" : o_.pair.left;
    all_settings();
    results_.target.reserve(isas_.size());
    for (const std::string& isa : isas_)
      results_.target.push_back(target_frame(isa));
    for (const Size& size : plan_.scaling_sizes) {
      BenchSetting s = setting(size, plan_.scaling_disparities, 1);
      s.rows = {"sad", "census", "sgm", "frame"};
      results_.scaling.push_back(measure(s, isas_.front()));
    }
    for (const std::string& isa : isas_)
      kernels_and_peak(isa);
    (void)use_isa("best");
    return std::move(results_);
  }

 private:
  std::size_t steps() const {
    const std::size_t threads = usable_processors() > 1 ? 2 : 1;
    return plan_.sizes.size() * plan_.disparities.size() * threads * isas_.size() + 2 * isas_.size() +
           plan_.scaling_sizes.size();
  }

  BenchSetting setting(const Size& size, int disparities, int threads) const {
    BenchSetting s;
    s.width = size.width;
    s.height = size.height;
    s.threads = threads;
    s.config = bench_config(disparities, o_.sets);
    s.rounds = plan_.rounds;
    s.reference_runs = 0;
    s.pair = o_.pair;
    return s;
  }

  void announce(const BenchSetting& s, const std::string& isa, const std::string& what) {
    progress_.next(std::to_string(s.width) + "x" + std::to_string(s.height) + "x" +
                   std::to_string(s.config.matcher.disparities) + " " + isa + " " + std::to_string(s.threads) +
                   (s.threads == 1 ? " thread " : " threads ") + what);
  }

  BenchResult measure(const BenchSetting& s, const std::string& isa) {
    (void)use_isa(isa);
    announce(s, isa, "");
    return run_bench(s, [](const std::string&) {});
  }

  void all_settings() {
    for (const Size& size : plan_.sizes) {
      for (const int disparities : plan_.disparities) {
        for (const int threads : threads_) {
          for (const std::string& isa : isas_) {
            BenchSetting s = setting(size, disparities, threads);
            // The scalar reference is slow: once is enough to see by how much.
            if (results_.settings.empty()) s.reference_runs = 2;
            results_.settings.push_back(measure(s, isa));
          }
        }
      }
    }
  }

  BenchResult target_frame(const std::string& isa) {
    BenchSetting s = setting(plan_.target_size, 64, std::min(kTargetThreads, usable_processors()));
    s.rows = {"frame"};
    return measure(s, isa);
  }

  void kernels_and_peak(const std::string& isa) {
    (void)use_isa(isa);
    const BenchSetting s = setting(plan_.kernel_size, 64, 1);
    announce(s, isa, "kernels one by one");
    for (const KernelTime& kernel : time_kernels(s, plan_.kernel_runs))
      results_.kernels.push_back(kernel);
    results_.peaks.push_back(measure_peak());
  }

  const SuiteOptions& o_;
  Plan plan_;
  std::vector<std::string> isas_;
  std::vector<int> threads_;
  Progress progress_;
  SuiteResults results_;
};

}  // namespace

SuiteResults run_suite(const SuiteOptions& options) {
  return Suite(options).run();
}

LineFit fit_line(const std::vector<Point>& points) {
  const auto n = static_cast<double>(points.size());
  double x = 0;
  double y = 0;
  for (const Point& p : points) {
    x += p.x / n;
    y += p.y / n;
  }
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const Point& p : points) {
    xx += (p.x - x) * (p.x - x);
    xy += (p.x - x) * (p.y - y);
    yy += (p.y - y) * (p.y - y);
  }
  if (!(xx > 0 && yy > 0)) return {y, 0, 0};
  return {y - xy / xx * x, xy / xx, xy * xy / (xx * yy)};
}

std::vector<Point> scaling_points(const std::vector<BenchResult>& scaling, const std::string& row) {
  std::vector<Point> points;
  for (const BenchResult& r : scaling) {
    for (const BenchRow& found : r.rows) {
      if (found.name == row) points.push_back({1e-6 * r.width * r.height * r.disparities, found.ms});
    }
  }
  return points;
}

}  // namespace lakshya
