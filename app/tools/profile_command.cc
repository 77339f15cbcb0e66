#include "app/tools/profile_command.h"

#include <omp.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "app/tools/profile_report.h"
#include "app/tools/profile_run.h"
#include "app/tools/profile_trace.h"
#include "app/tools/stereo_input.h"
#include "hal/clock/monotonic_clock.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

constexpr int kMaxFrames = 100'000;  // the trace of so many is 100 MB

struct ProfileOptions {
  StereoInputOptions input;
  ConfigOptions config;
  KernelOptions kernels;
  int frames = 100;
  std::optional<int> threads;
  std::string trace;
  bool json = false;
};

void require_ok(Status status, const std::string& path) {
  if (status != Status::ok) throw InputError(path, std::string("cannot be processed: ") + to_string(status));
}

void profile(const ProfileOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  const StereoFrames frames(o.input, config.camera.calibration_unit_m);
  if (o.threads) omp_set_num_threads(*o.threads);
  const KernelTable kernels = choose_kernels(o.kernels);
  const MonotonicClock clock;
  StereoInput input = frames.read(0);
  const int width = input.left.width();
  const int height = input.left.height();
  Pipeline pipeline(config, input.calibration, width, height, kernels, clock);
  ProfileRun run(o.trace.empty() ? 0 : static_cast<std::size_t>(o.frames));
  {
    // The first call makes OpenMP's threads and touches the memory for the first time; it does not count.
    FrameResult first;
    require_ok(pipeline.process(input.left.view(), input.right.view(), {}, first), input.left_path);
    pipeline.clear_times();
  }
  for (int n = 0; n < o.frames; ++n) {
    if (n > 0 && !frames.is_single()) input = frames.read(n);
    require_ok(run.frame(pipeline, input.left.view(), input.right.view()), input.left_path);
  }
  if (!o.trace.empty()) write_file_atomically(o.trace, trace_json(run.trace()));
  const ProfileReport report{.isa = active_isa(),
                             .backend = o.kernels.backend,
                             .matcher = config.matcher.name,
                             .threads = omp_get_max_threads(),
                             .width = width,
                             .height = height,
                             .disparities = config.matcher.disparities,
                             .arena_bytes = pipeline.arena_bytes(),
                             .measuring = measuring_cost(clock),
                             .times = pipeline.times(),
                             .counts = run.counts()};
  if (o.json) {
    std::cout << profile_json(report).dump() << '\n';
    return;
  }
  std::cout << profile_table(report);
  if (!o.trace.empty()) std::cout << "trace: " << o.trace << " (open it in ui.perfetto.dev or chrome://tracing)\n";
}

void add_options(CLI::App& command, ProfileOptions& o) {
  add_stereo_input_options(command, o.input);
  add_config_options(command, o.config);
  add_kernel_options(command, o.kernels);
  command
      .add_option("--frames", o.frames, "Frames measured: those of a folder in turn, or one pair again and again")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxFrames));
  command.add_option("--threads", o.threads, "Threads; default: OMP_NUM_THREADS, else all cores")
      ->check(CLI::Range(1, 1024));
  command.add_option("--trace", o.trace, "Also write every frame's stages as Chrome/Perfetto trace events")
      ->type_name("FILE");
  command.add_flag("--json", o.json, "Print JSON instead of a table");
  command.footer(
      "Reading the images is not measured. One frame before the first is not counted: it makes the threads.\n"
      "Example: lakshya profile --left left.png --right right.png --calib calib.txt --frames 100 --threads 1\n"
      "Folder:  lakshya profile --sequence sequences/06 --frames 51 --trace out/trace.json");
}

}  // namespace

void add_profile_command(CLI::App& app) {
  auto options = std::make_shared<ProfileOptions>();
  CLI::App* command = app.add_subcommand("profile", "How long does a frame take, stage by stage?");
  add_options(*command, *options);
  command->callback([options] { profile(*options); });
}

}  // namespace lakshya
