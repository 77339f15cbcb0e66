#include "app/tools/soak_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "app/loop/real_time.h"
#include "app/tools/output_folder.h"
#include "app/tools/progress.h"
#include "app/tools/soak_report.h"

namespace lakshya {
namespace {

struct SoakOptions {
  std::string source;
  std::string right;
  std::vector<std::string> calibration;
  ConfigOptions config;
  KernelOptions kernels;
  SoakSettings settings;
  std::string out;
};

// A bar in steps of a thousandth.
class SoakProgress {
 public:
  explicit SoakProgress(std::uint64_t frames) : frames_(frames), progress_(kSteps) {}

  void show(const SoakResult& result) {
    const auto step = static_cast<std::size_t>(std::min(result.frames, frames_) * kSteps / frames_);
    if (step == shown_) return;
    shown_ = step;
    progress_.done(step, std::to_string(result.frames) + " frames");
  }

 private:
  static constexpr std::size_t kSteps = 1000;
  std::uint64_t frames_;
  std::size_t shown_ = 0;
  Progress progress_;
};

void soak(const SoakOptions& o) {
  std::optional<OutputFolder> folder;
  if (!o.out.empty()) folder.emplace(o.out);  // refuses before the long work, not after it
  VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  std::vector<std::string> source{o.source};
  if (!o.right.empty()) source.push_back(o.right);
  name_recording(config, source, o.calibration);
  SoakSettings settings = o.settings;
  settings.source = o.source;
  settings.config_path = o.config.config;
  const KernelTable kernels = choose_kernels(o.kernels);
  SoakResult result;
  {
    SoakProgress progress(settings.frames);
    result = run_soak(soak_config(std::move(config)), settings, kernels,
                      [&](const SoakResult& so_far) { progress.show(so_far); });
  }
  std::cout << soak_text(result);
  if (folder) {
    write_file_atomically(folder->file("soak.json"), soak_json(result).dump(2) + "\n");
    write_png(folder->file("soak.png"), soak_picture(result).view());
    folder->commit("");
    std::cout << "results: " << o.out << "/soak.json and soak.png\n";
  }
  if (!soak_verdict(result).failures.empty()) throw CLI::RuntimeError(1);
}

}  // namespace

void add_soak_command(CLI::App& app, char** argv) {
  auto o = std::make_shared<SoakOptions>();
  CLI::App* command =
      app.add_subcommand("soak", "Endurance: the main loop for many frames while its devices fail now and then");
  command
      ->add_option("source", o->source,
                   "Sequence (KITTI odometry, EuRoC, or a folder with left and right), or the left image")
      ->required()
      ->type_name("SOURCE");
  command->add_option("--right", o->right, "The right image, or folder, where SOURCE is the left one")
      ->type_name("IMAGE");
  command
      ->add_option("--calib", o->calibration,
                   "Calibration file, two files, or a folder; default: camera.calibration, else the sequence's own")
      ->expected(1, 2)
      ->type_name("FILE");
  command->add_option("--frames", o->settings.frames, "End after so many")
      ->check(CLI::Range(std::uint64_t{100}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
  command->add_option("--seed", o->settings.seed, "Of the faults; the same seed gives the same ones")
      ->capture_default_str();
  command->add_option("--out", o->out, "Write soak.json and soak.png into this folder")->type_name("DIR");
  add_config_options(*command, o->config);
  add_kernel_options(*command, o->kernels);
  command->footer(
      "The firmware's loop on a virtual clock; the recording begins again after its last pair. Faults of camera, "
      "compass,\n"
      "drives and emergency stop come one after the other, sometimes two at once. Not passed (exit code 1): the "
      "wheels do\n"
      "not stand 200 ms after a fault's beginning, the vehicle does not drive again in time, drives before a reset "
      "that it\n"
      "needs, the loop allocates, memory or open handles grow. A frame that takes longer at the end is only warned "
      "of:\n"
      "others may use the machine.\n"
      "Example: lakshya soak sequences/06 --set camera.height_m=1.65 --frames 20000 --out out/soak");
  command->callback([o, argv] {
    require_openmp_settings(argv);
    soak(*o);
  });
}

}  // namespace lakshya
