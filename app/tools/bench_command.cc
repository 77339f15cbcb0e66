#include "app/tools/bench_command.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>

#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/lakshyad/options.h"
#include "app/tools/bench_report.h"
#include "app/tools/bench_suite.h"
#include "app/tools/output_folder.h"
#include "app/tools/progress.h"

namespace lakshya {
namespace {

struct BenchOptions {
  std::string size = "640x480";
  int disparities = 64;
  int threads = 1;
  int runs = 0;
  int reference_runs = 3;
  std::vector<std::string> rows{kBenchRows.begin(), kBenchRows.end()};
  std::vector<std::string> sets;
  KernelOptions kernels;
  BenchPair pair;
  std::string out;
  bool quick = false;
  bool thread_time = false;
  bool json = false;
};

// "640x480"
void parse_size(const std::string& text, BenchSetting& setting) {
  const char* end = text.data() + text.size();
  const auto [cross, width_error] = std::from_chars(text.data(), end, setting.width);
  if (width_error == std::errc() && cross != end && *cross == 'x') {
    const auto [rest, height_error] = std::from_chars(cross + 1, end, setting.height);
    if (height_error == std::errc() && rest == end) return;
  }
  throw InputError("--size", "'" + text + "' is no size (write WIDTHxHEIGHT: 640x480)");
}

void run_all(const BenchOptions& o) {
  OutputFolder folder(o.out);  // refuses before the long work, not after it
  const SuiteResults results = run_suite({o.quick, o.pair, o.sets});
  const std::string table = suite_markdown(results);
  write_file_atomically(folder.file("bench.json"), suite_json(results));
  write_file_atomically(folder.file("bench.md"), table);
  write_png(folder.file("speedup.png"), speedup_plot(results).view());
  write_png(folder.file("scaling.png"), scaling_plot(results).view());
  write_png(folder.file("roofline.png"), roofline_plot(results).view());
  folder.commit("");
  std::cout << table << "results: " << o.out << "/bench.md, bench.json, speedup.png, scaling.png, roofline.png\n";
}

void run(const BenchOptions& o) {
  if (o.thread_time && o.threads != 1) throw InputError("--thread-time", "is right for one thread only");
  use_bench_clock(o.thread_time ? BenchClock::thread : BenchClock::wall);
  BenchSetting setting;
  parse_size(o.size, setting);
  setting.threads = o.threads;
  setting.backend = o.kernels.backend;
  setting.kernels = choose_kernels(o.kernels);
  setting.config = bench_config(round_up_to_16(o.disparities), o.sets);
  setting.rows = o.rows;
  setting.rounds.rounds = o.runs;
  setting.reference_runs = o.reference_runs;
  setting.pair = o.pair;
  BenchResult result;
  {
    Progress progress(kBenchRows.size());
    result = run_bench(setting, [&](const std::string& row) { progress.next(row); });
  }
  if (o.json) {
    nlohmann::ordered_json json = bench_json(result);
    json["opencv"] = opencv_build_json(opencv_build());
    std::cout << json.dump() << "\n";
  } else {
    std::cout << bench_text(result) << opencv_build_text(opencv_build());
  }
}

void add_options(CLI::App& command, BenchOptions& o) {
  command.add_option("--size", o.size, "WIDTHxHEIGHT of the images; default 640x480");
  command
      .add_option("--disparities", o.disparities, "Number of disparities searched, rounded up to a multiple of 16")
      ->check(CLI::Range(1, 512));
  command.add_option("--threads", o.threads, "For ours and for OpenCV's");
  command.add_option("--runs", o.runs, "Runs of each; default: 15, more where they are short")
      ->check(CLI::Range(1, 10000));
  command.add_option("--ref-runs", o.reference_runs, "Runs of the scalar reference, which is slow; 0: none")
      ->check(CLI::Range(0, 1000));
  command.add_option("--rows", o.rows, "Only these rows")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{kBenchRows.begin(), kBenchRows.end()}));
  CLI::Option* left =
      command.add_option("--left", o.pair.left, "Rectified pair to measure on; without: a made-up scene");
  CLI::Option* right = command.add_option("--right", o.pair.right, "Its right image");
  left->needs(right);
  right->needs(left);
  command.add_option("--shift", o.pair.shift, "Disparity of the pair that becomes 0, px of its images")
      ->needs(left);
  command.add_option("--set", o.sets, "Override one value of the configuration; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_kernel_options(command, o.kernels);
  CLI::Option* all = command.add_option(
      "--out", o.out,
      "Instead of one setting: sizes, disparities, threads and instruction sets in one run, into this folder");
  for (const char* one :
       {"--size", "--disparities", "--threads", "--runs", "--ref-runs", "--rows", "--backend", "--isa"})
    all->excludes(command.get_option(one));
  command.add_flag("--quick", o.quick, "With --out: small images and few runs")->needs(all);
  command
      .add_flag("--thread-time", o.thread_time,
                "Count the processor's time for the thread instead of the wall's: one thread on a busy machine")
      ->excludes(all);
  command.add_flag("--json", o.json, "Print JSON instead of a table")->excludes(all);
  command.footer(
      "Medians; ours and OpenCV's take turns. Rows: docs/performance.md.\n"
      "Example: lakshya bench --size 640x480 --disparities 64 --threads 1 --isa avx2");
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command =
      app.add_subcommand("bench", "Time of the kernels, matchers and the whole frame beside OpenCV's");
  add_options(*command, *options);
  command->callback([options] {
    if (options->out.empty()) {
      run(*options);
    } else {
      run_all(*options);
    }
  });
}

}  // namespace lakshya
